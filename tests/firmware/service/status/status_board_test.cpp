// SPDX-License-Identifier: MIT
#include "firmware/service/status/status_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <chrono>
#include <ctime>
#include <iomanip>
#include <nlohmann/json.hpp>
#include <sstream>

namespace plumbline::service {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

capture::Decision phase(capture::Phase phase) {
  return {HostTime{}, capture::PhaseChanged{phase, 50.0}};
}

void hear_fix(StatusBoard& board) {
  capture::FixHeard heard;
  heard.fix.quality = FixQuality::kFixed;
  board.heard({HostTime{}, heard});
}

// On the ground, with all that it needs.
void make_ready(StatusBoard& board) {
  hear_fix(board);
  board.heard({HostTime{}, capture::CameraSeen{true}});
  board.decided(phase(capture::Phase::kReady));
}

TEST(StatusBoard, IsNotReadyOnceReceiverOrCameraHasGone) {
  StatusBoard::Time now;
  StatusBoard board(true, {}, [&now] { return now; });
  make_ready(board);
  EXPECT_THAT(board.sentence(), HasSubstr("Ready: fixed"));
  board.heard({HostTime{}, capture::CameraSeen{false}});
  EXPECT_EQ(board.sentence(), "Not ready: no picture from the camera.");
  board.heard({HostTime{}, capture::CameraSeen{true}});
  now += std::chrono::seconds(6);
  EXPECT_EQ(board.sentence(), "Not ready: no position.");
  hear_fix(board);
  EXPECT_THAT(board.sentence(), HasSubstr("Ready: fixed"));
  capture::FixHeard lost;
  lost.fix.quality = FixQuality::kNone;
  board.heard({HostTime{}, lost});
  EXPECT_EQ(board.sentence(), "Not ready: no position.");
}

TEST(StatusBoard, SaysWhatIsMissingWhileItWaits) {
  StatusBoard board;
  EXPECT_THAT(board.sentence(), HasSubstr("Waiting for a position"));
  hear_fix(board);
  EXPECT_THAT(board.sentence(), HasSubstr("Waiting for the camera"));
}

TEST(StatusBoard, ClaimsNoPositionThatIsOfLongAgo) {
  StatusBoard::Time now;
  StatusBoard board(true, {}, [&now] { return now; });
  board.decided(phase(capture::Phase::kFlying));
  capture::FixHeard heard;
  heard.fix.quality = FixQuality::kFixed;
  heard.fix.height_ellipsoidal_m = 80;
  board.heard({HostTime{}, heard});
  now += std::chrono::seconds(4);
  EXPECT_THAT(board.sentence(), HasSubstr("Flying: fixed;"));
  EXPECT_EQ(nlohmann::json::parse(board.json())["height_above_take_off_m"], 30);
  now += std::chrono::seconds(2);
  EXPECT_THAT(board.sentence(), HasSubstr("Flying: no position;"));
  const auto json = nlohmann::json::parse(board.json());
  EXPECT_EQ(json["quality"], 0);
  EXPECT_FALSE(json.contains("height_above_take_off_m"));
}

TEST(StatusBoard, SaysInFlightThatThereIsNoCamera) {
  StatusBoard board;
  board.decided(phase(capture::Phase::kFlying));
  EXPECT_THAT(board.sentence(), HasSubstr("No camera"));
  board.heard({HostTime{}, capture::CameraSeen{true}});
  EXPECT_THAT(board.sentence(), Not(HasSubstr("No camera")));
  StatusBoard of_pulses(false);
  of_pulses.decided(phase(capture::Phase::kFlying));
  EXPECT_THAT(of_pulses.sentence(), Not(HasSubstr("No camera")));
}

TEST(StatusBoard, IsNotReadyWhereTheDiskHasNoRoomForTheFlight) {
  StatusBoard board;
  make_ready(board);
  board.space(14, 14);
  EXPECT_THAT(board.sentence(), HasSubstr("Ready: "));
  EXPECT_THAT(board.sentence(), HasSubstr("14 photos fit"));
  board.space(13, 14);
  EXPECT_THAT(board.sentence(), HasSubstr("Not ready: the disk has room for 13 photos of 14"));
  EXPECT_THAT(board.sentence(), HasSubstr("move old flights"));
  EXPECT_EQ(nlohmann::json::parse(board.json())["planned_photos"], 14);
}

TEST(StatusBoard, SaysWhichHeightsHaveNoPhotoUntilTheyHave) {
  StatusBoard board;
  board.decided(phase(capture::Phase::kFlying));
  board.decided({HostTime{}, capture::HeightPassed{{capture::Reason::kHeight, 3, 45}}});
  board.decided({HostTime{}, capture::HeightPassed{{capture::Reason::kHeight, 4, 47.5}}});
  EXPECT_THAT(board.sentence(), HasSubstr("No photo at 45 m, 47.5 m: fly there again."));
  capture::PhotoTaken taken;
  taken.target = {capture::Reason::kHeight, 3, 45};
  board.decided({HostTime{}, taken});
  EXPECT_THAT(board.sentence(), HasSubstr("No photo at 47.5 m:"));
  board.decided(phase(capture::Phase::kLanded));
  EXPECT_THAT(board.sentence(), HasSubstr("No photo at 47.5 m."));
}

TEST(StatusBoard, SaysWhileItWaitsThatTheDiskHasNoRoom) {
  StatusBoard board;
  board.space(13, 14);
  EXPECT_THAT(board.sentence(), HasSubstr("Waiting for a position; the disk has room for 13 "));
  board.space(14, 14);
  EXPECT_EQ(board.sentence(), "Waiting for a position.");
}

TEST(StatusBoard, SaysWhatIsConfiguredToBeginAFlight) {
  capture::TakeOffOptions take_off;
  take_off.rise_m = 2.5;
  StatusBoard by_height(true, take_off);
  make_ready(by_height);
  EXPECT_THAT(by_height.sentence(), HasSubstr("takes off at 2.5 m of rise"));
  EXPECT_THAT(by_height.sentence(), Not(HasSubstr("autopilot")));

  take_off.by = capture::TakeOffBy::kArmed;
  StatusBoard by_pilot(true, take_off);
  make_ready(by_pilot);
  EXPECT_THAT(by_pilot.sentence(), HasSubstr("no autopilot heard: takes off at 2.5 m of rise"));
  by_pilot.heard({HostTime{}, capture::PilotSeen{false}});
  EXPECT_THAT(by_pilot.sentence(), HasSubstr("begins when the autopilot is armed"));
  EXPECT_THAT(by_pilot.sentence(), Not(HasSubstr("rise")));
  by_pilot.heard({HostTime{}, capture::PilotSeen{}});
  EXPECT_THAT(by_pilot.sentence(), HasSubstr("no autopilot heard: takes off at 2.5 m of rise"));
}

TEST(StatusBoard, IsNotReadyWithoutTheLineThatReleasesPhotos) {
  StatusBoard of_pulses(false);
  make_ready(of_pulses);
  of_pulses.said({HostTime{}, record::Severity::kFault, "shutter line", "It is not there."});
  EXPECT_THAT(of_pulses.sentence(), HasSubstr("Not ready: no line to the shutter."));
  EXPECT_THAT(of_pulses.sentence(), HasSubstr("It is not there."));
  of_pulses.said({HostTime{}, record::Severity::kInfo, "shutter line", "It is there."});
  EXPECT_THAT(of_pulses.sentence(), HasSubstr("Ready: "));
}

TEST(StatusBoard, SaysThatThePulsePerSecondIsMissing) {
  StatusBoard board;
  make_ready(board);
  board.said({HostTime{}, record::Severity::kFault, "pulse per second", "No /dev/pps0."});
  EXPECT_THAT(board.sentence(), HasSubstr("Ready: "));
  EXPECT_THAT(board.sentence(), HasSubstr("No /dev/pps0."));
}

TEST(StatusBoard, ForgetsTheResultOfTheFlightBeforeAtTakeOff) {
  StatusBoard board;
  board.decided(phase(capture::Phase::kFlying));
  board.decided(phase(capture::Phase::kLanded));
  board.measured("Flight 0001: measured.");
  EXPECT_THAT(board.sentence(), HasSubstr("Flight 0001"));
  board.decided(phase(capture::Phase::kReady));
  EXPECT_THAT(board.sentence(), HasSubstr("Flight 0001"));
  board.decided(phase(capture::Phase::kFlying));
  board.decided(phase(capture::Phase::kLanded));
  EXPECT_THAT(board.sentence(), Not(HasSubstr("Flight 0001")));
  EXPECT_EQ(nlohmann::json::parse(board.json())["result"], "");
}

TEST(StatusBoard, NamesItsProcessAndTheTimeInUtc) {
  const auto before = std::chrono::system_clock::now() - std::chrono::seconds(1);
  const auto json = nlohmann::json::parse(StatusBoard().json());
  const auto after = std::chrono::system_clock::now();
  EXPECT_EQ(json["pid"], ::getpid());
  std::istringstream text(json.value("time", ""));
  std::tm utc{};
  text >> std::get_time(&utc, "%Y-%m-%dT%H:%M:%SZ");
  ASSERT_FALSE(text.fail()) << text.str();
  const auto time = std::chrono::system_clock::from_time_t(::timegm(&utc));
  EXPECT_GE(time, before);
  EXPECT_LE(time, after);
}

TEST(StatusBoard, ClaimsNothingOnceItIsStopped) {
  StatusBoard board;
  capture::FixHeard heard;
  heard.fix.quality = FixQuality::kFixed;
  board.heard({HostTime{}, heard});
  board.heard({HostTime{}, capture::CameraSeen{true}});
  board.said({HostTime{}, record::Severity::kFault, "disk", "The disk is full."});
  board.decided(phase(capture::Phase::kFlying));
  board.stopped();
  const auto json = nlohmann::json::parse(board.json());
  EXPECT_EQ(json["phase"], "stopped");
  EXPECT_EQ(json["quality"], 0);
  EXPECT_EQ(json["camera_streaming"], false);
  EXPECT_FALSE(json.contains("trouble"));
  EXPECT_THAT(board.sentence(), HasSubstr("stopped in flight; started again, it goes on"));
}

TEST(StatusBoard, CountsThePhotosOfTheFlightAndShowsThemAsJson) {
  StatusBoard board;
  board.decided(phase(capture::Phase::kFlying));
  capture::PhotoTaken taken;
  taken.number = 1;
  taken.marks.late = true;
  board.decided({HostTime{}, taken});
  board.stored(1, "0001");
  const auto json = nlohmann::json::parse(board.json());
  EXPECT_EQ(json["photos_taken"], 1);
  EXPECT_EQ(json["photos_stored"], 1);
  EXPECT_EQ(json["photos_marked"], 1);
  EXPECT_EQ(json["phase"], "flying");
  EXPECT_EQ(json["flight"], "0001");
}

TEST(StatusBoard, ShowsTroubleUntilItIsOver) {
  StatusBoard board;
  board.said({HostTime{}, record::Severity::kFault, "disk", "The disk is full."});
  EXPECT_THAT(board.sentence(), HasSubstr("The disk is full."));
  board.said({HostTime{}, record::Severity::kInfo, "disk", "It takes what is written again."});
  EXPECT_THAT(board.sentence(), Not(HasSubstr("full")));
}

}  // namespace
}  // namespace plumbline::service
