// SPDX-License-Identifier: MIT
#include "edge/mavlink/conversation.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

#include "edge/mavlink/messages.h"
#include "tests/edge/mavlink/frames_read.h"
#include "tests/edge/mavlink/reference_frames.h"
#include "tests/talk/pilot_talk.h"

namespace plumbline::mavlink {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using talk::from_hex;

class ConversationTest : public testing::Test {
 protected:
  void hear(const std::string& bytes) { conversation_.feed(now_, bytes); }

  template <typename Message>
  std::vector<Message> heard() const {
    std::vector<Message> of_kind;
    for (const PilotMessage& message : messages_) {
      if (const auto* found = std::get_if<Message>(&message)) of_kind.push_back(*found);
    }
    return of_kind;
  }

  Frame sent(const std::string& bytes) {
    const FramesRead read = read_frames(bytes);
    return read.frames.size() == 1 ? read.frames[0] : Frame{0, 0, 0, 0, 0, ""};
  }

  HostTime now_{seconds(100)};
  std::vector<PilotMessage> messages_;
  Conversation conversation_{[this](const PilotMessage& said) { messages_.push_back(said); }};
};

TEST_F(ConversationTest, HearsWhatAnotherImplementationSays) {
  hear(from_hex(reference::kHeartbeat) + from_hex(reference::kAttitude) +
       from_hex(reference::kPosition));
  const auto heartbeats = heard<PilotHeartbeat>();
  ASSERT_EQ(heartbeats.size(), 1u);
  EXPECT_EQ(heartbeats[0].arrival, now_);
  EXPECT_TRUE(heartbeats[0].armed);
  EXPECT_EQ(heartbeats[0].system_id, 1);
  EXPECT_EQ(heartbeats[0].autopilot, 3);
  EXPECT_EQ(heartbeats[0].vehicle_type, 2);
  EXPECT_EQ(heartbeats[0].system_status, 4);

  const auto attitudes = heard<PilotAttitude>();
  ASSERT_EQ(attitudes.size(), 1u);
  EXPECT_EQ(attitudes[0].time_boot, milliseconds(123456));
  EXPECT_FLOAT_EQ(static_cast<float>(attitudes[0].roll_rad), 0.0125f);
  EXPECT_FLOAT_EQ(static_cast<float>(attitudes[0].pitch_rad), -0.05f);
  EXPECT_EQ(attitudes[0].yaw_rad, 1.5);

  const auto positions = heard<PilotPosition>();
  ASSERT_EQ(positions.size(), 1u);
  EXPECT_EQ(positions[0].time_boot, milliseconds(123460));
  EXPECT_NEAR(positions[0].latitude_deg.value(), 35.6687390, 1e-12);
  EXPECT_NEAR(positions[0].longitude_deg.value(), 139.7610904, 1e-12);
  EXPECT_NEAR(positions[0].altitude_msl_m, 52.140, 1e-12);
  EXPECT_NEAR(positions[0].relative_altitude_m, -0.310, 1e-12);
  // North -0.12, east 0.34, down -3.00.
  EXPECT_NEAR((positions[0].velocity_enu_m_s - Eigen::Vector3d(0.34, -0.12, 3.0)).norm(), 0, 1e-12);
  EXPECT_NEAR(positions[0].heading_deg.value(), 359.99, 1e-12);
}

TEST_F(ConversationTest, TellsArmedFromNot) {
  hear(talk::vehicle_heartbeat(false) + talk::vehicle_heartbeat(true));
  const auto heartbeats = heard<PilotHeartbeat>();
  ASSERT_EQ(heartbeats.size(), 2u);
  EXPECT_FALSE(heartbeats[0].armed);
  EXPECT_TRUE(heartbeats[1].armed);
}

TEST_F(ConversationTest, KnowsNoPositionAndNoHeadingWhereNoneIsSent) {
  hear(talk::vehicle_heartbeat(true) +
       talk::pilot_frame({"GLOBAL_POSITION_INT", {{"relative_alt", 1500}, {"hdg", 65535}}, ""}));
  const auto positions = heard<PilotPosition>();
  ASSERT_EQ(positions.size(), 1u);
  EXPECT_FALSE(positions[0].latitude_deg || positions[0].longitude_deg);
  EXPECT_FALSE(positions[0].heading_deg);
  EXPECT_DOUBLE_EQ(positions[0].relative_altitude_m, 1.5);
}

TEST_F(ConversationTest, HandsOnNoPositionBeyondThePoles) {
  hear(talk::vehicle_heartbeat(true) +
       talk::pilot_frame({"GLOBAL_POSITION_INT", {{"lat", 900000001}, {"lon", 5}}, ""}));
  ASSERT_EQ(heard<PilotPosition>().size(), 1u);
  EXPECT_FALSE(heard<PilotPosition>()[0].latitude_deg);
}

TEST_F(ConversationTest, DropsAnAttitudeThatIsNoNumber) {
  hear(talk::vehicle_heartbeat(true) +
       talk::vehicle_attitude(5, std::numeric_limits<double>::quiet_NaN()));
  EXPECT_TRUE(heard<PilotAttitude>().empty());
  EXPECT_EQ(conversation_.counters().malformed, 1u);
}

TEST_F(ConversationTest, ListensToOneAutopilotAndToNoGimbalOrGroundStation) {
  const std::string ground_station =
      talk::pilot_frame({"HEARTBEAT", {{"type", 6}, {"autopilot", 8}}, ""}, {.system = 255});
  const std::string gimbal =
      talk::pilot_frame({"HEARTBEAT", {{"type", 26}, {"autopilot", 8}}, ""}, {.component = 154});
  hear(ground_station + gimbal + talk::vehicle_attitude(1, 0.1, {.component = 154}));
  EXPECT_TRUE(messages_.empty());
  hear(talk::vehicle_heartbeat(true, {.system = 7}) +
       talk::vehicle_attitude(2, 0.2, {.system = 7}) +
       talk::vehicle_attitude(3, 0.3, {.system = 7, .component = 154}) +
       talk::vehicle_heartbeat(false, {.system = 8}) +
       talk::vehicle_attitude(4, 0.4, {.system = 8}));
  ASSERT_EQ(messages_.size(), 2u);
  EXPECT_EQ(heard<PilotHeartbeat>()[0].system_id, 7);
  EXPECT_EQ(heard<PilotAttitude>()[0].time_boot, milliseconds(2));
  EXPECT_EQ(conversation_.counters().of_others, 6u);
}

TEST_F(ConversationTest, TurnsToAnotherAutopilotOnlyWhenItsOwnIsLost) {
  hear(talk::vehicle_heartbeat(true, {.system = 7}));
  now_ += milliseconds(4900);
  hear(talk::vehicle_heartbeat(true, {.system = 8}));
  EXPECT_EQ(messages_.size(), 1u);
  now_ += milliseconds(200);
  hear(talk::vehicle_heartbeat(true, {.system = 8}));
  ASSERT_EQ(messages_.size(), 2u);
  EXPECT_EQ(sent(conversation_.heartbeat()).system_id, 8);
}

TEST_F(ConversationTest, SendsTheFramesThatAnotherImplementationMakes) {
  EXPECT_EQ(conversation_.heartbeat(), from_hex(reference::kOwnHeartbeat));
  EXPECT_EQ(conversation_.text(PilotSeverity::kInfo, "height 2.1 cm: land"),
            from_hex(reference::kOwnText));
}

TEST_F(ConversationTest, SpeaksMavlink1WhereTheVehicleSpeaksNothingElse) {
  hear(from_hex(reference::kHeartbeatV1));
  EXPECT_EQ(conversation_.heartbeat(), from_hex(reference::kOwnHeartbeatV1));
  // The payload is full, and without the extension fields.
  EXPECT_EQ(conversation_.text(PilotSeverity::kInfo, "height 2.1 cm: land"),
            talk::pilot_frame({"STATUSTEXT", {{"severity", 6}}, "height 2.1 cm: land"},
                              {.version = 1, .sequence = 1, .component = 191}));
  hear(from_hex(reference::kAttitude));
  EXPECT_EQ(sent(conversation_.heartbeat()).version, 2);
  hear(from_hex(reference::kHeartbeatV1));
  EXPECT_EQ(sent(conversation_.heartbeat()).version, 2);
}

TEST_F(ConversationTest, BearsTheNumberOfTheVehicleAndCountsItsFrames) {
  EXPECT_EQ(sent(conversation_.heartbeat()).system_id, 1);
  hear(talk::vehicle_heartbeat(true, {.system = 42}));
  for (int i = 1; i < 600; ++i) {
    const Frame frame = sent(conversation_.heartbeat());
    ASSERT_EQ(frame.system_id, 42);
    ASSERT_EQ(frame.component_id, 191);
    ASSERT_EQ(frame.sequence, i % 256);
  }
}

TEST(Fitted, LeavesWhatFits) {
  EXPECT_EQ(fitted("good: land"), "good: land");
  const std::string fifty(50, 'x');
  EXPECT_EQ(fitted(fifty), fifty);
  EXPECT_EQ(fitted(""), "");
}

TEST(Fitted, CutsALongTextAfterAWord) {
  const std::string text = "height 2.1 cm, azimuth unknown: move 10 m sideways, then land";
  EXPECT_EQ(fitted(text), "height 2.1 cm, azimuth unknown: move 10 m");
  EXPECT_EQ(fitted("12345678901234567890123456789012345678901234567890 more").size(), 50u);
}

TEST(Fitted, CutsAWordThatFillsItAlone) {
  EXPECT_EQ(fitted(std::string(60, 'x')), std::string(50, 'x'));
}

TEST(Fitted, WritesOneSignForWhatIsNotAscii) {
  EXPECT_EQ(fitted("5 \xC2\xB5m \xE2\x82\xAC\nend"), "5 ?m ? end");
}

TEST(StatusTexts, AreReadAsTheyWereWritten) {
  Conversation conversation([](const PilotMessage&) {});
  for (const std::string& text : {std::string("good: land"), std::string(50, 'y'), std::string()}) {
    const FramesRead read = read_frames(conversation.text(PilotSeverity::kWarning, text));
    ASSERT_EQ(read.frames.size(), 1u);
    const auto status = status_text_of(read.frames[0]);
    ASSERT_TRUE(status);
    EXPECT_EQ(status->severity, PilotSeverity::kWarning);
    EXPECT_EQ(status->text, text);
  }
}

}  // namespace
}  // namespace plumbline::mavlink
