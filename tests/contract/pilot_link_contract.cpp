// SPDX-License-Identifier: MIT
#include "tests/contract/pilot_link_contract.h"

#include <algorithm>

namespace plumbline::contract {

using std::chrono::milliseconds;

void PilotEvents::add(const PilotEvent& event) {
  const std::lock_guard lock(mutex_);
  events_.push_back(event);
}

std::size_t PilotEvents::count() const {
  const std::lock_guard lock(mutex_);
  return events_.size();
}

bool PilotEvents::has(PilotState state, std::size_t since_report) const {
  const auto reports = all<PilotReport>();
  const auto from =
      reports.begin() + static_cast<std::ptrdiff_t>(std::min(since_report, reports.size()));
  return std::any_of(from, reports.end(),
                     [state](const PilotReport& report) { return report.state == state; });
}

Status PilotLinkContract::start() {
  return bench_->link().start([this](const PilotEvent& event) { events_.add(event); });
}

bool PilotLinkContract::until(const std::function<bool()>& holds, const Talk& talk,
                              milliseconds at_most) {
  const HostTime end = bench_->now() + at_most;
  HostTime next = bench_->now();
  while (!holds()) {
    if (bench_->now() >= end) return false;
    if (talk && bench_->now() >= next) {
      talk();
      next = bench_->now() + milliseconds(100);
    }
    bench_->pass(milliseconds(10));
  }
  return true;
}

void PilotLinkContract::go_on_for(milliseconds time, const Talk& talk) {
  until([] { return false; }, talk, time);
}

bool PilotLinkContract::reports(PilotState state, const Talk& talk) {
  const std::size_t before = events_.all<PilotReport>().size();
  return until([&] { return events_.has(state, before); }, talk);
}

void PilotLinkContract::connect() {
  bench_->plug_in();
  ASSERT_TRUE(start());
  ASSERT_TRUE(reports(PilotState::kAutopilot, heartbeats_));
}

TEST_P(PilotLinkContract, HandsOnWhatTheAutopilotSaysWithItsArrival) {
  const HostTime begin = bench_->now();
  connect();
  bench_->attitude(123456, 1.5);
  bench_->position(123460, 42.5);
  ASSERT_TRUE(until([&] { return !events_.all<PilotPosition>().empty(); }));
  EXPECT_TRUE(events_.all<PilotHeartbeat>()[0].armed);
  const PilotAttitude attitude = events_.all<PilotAttitude>().at(0);
  EXPECT_EQ(attitude.time_boot, milliseconds(123456));
  EXPECT_EQ(attitude.yaw_rad, 1.5);
  EXPECT_NEAR(attitude.pitch_rad, -0.05, 1e-8);
  EXPECT_GE(attitude.arrival, begin);
  const PilotPosition position = events_.all<PilotPosition>().at(0);
  EXPECT_DOUBLE_EQ(position.relative_altitude_m, 42.5);
  EXPECT_GE(position.arrival, attitude.arrival);
  EXPECT_LE(position.arrival, bench_->now());
}

TEST_P(PilotLinkContract, TellsArmedFromDisarmed) {
  connect();
  const std::size_t before = events_.all<PilotHeartbeat>().size();
  bench_->heartbeat(false);
  ASSERT_TRUE(until([&] { return events_.all<PilotHeartbeat>().size() > before; }));
  EXPECT_FALSE(events_.all<PilotHeartbeat>().back().armed);
}

TEST_P(PilotLinkContract, ShowsTextsInTheOrderInWhichTheyWereSaid) {
  connect();
  for (int i = 0; i < 20; ++i) {
    bench_->link().say(i == 7 ? PilotSeverity::kWarning : PilotSeverity::kInfo,
                       "photo " + std::to_string(i));
  }
  ASSERT_TRUE(until([&] { return bench_->shown().size() >= 20; }));
  const std::vector<ShownText> shown = bench_->shown();
  ASSERT_EQ(shown.size(), 20u);
  for (int i = 0; i < 20; ++i) {
    EXPECT_EQ(shown[static_cast<std::size_t>(i)].text, "photo " + std::to_string(i));
  }
  EXPECT_EQ(shown[7].severity, PilotSeverity::kWarning);
  EXPECT_EQ(shown[8].severity, PilotSeverity::kInfo);
  EXPECT_TRUE(until([&] { return bench_->link().counters().texts_sent == 20; }));
}

TEST_P(PilotLinkContract, CutsALongTextAfterAWord) {
  connect();
  bench_->link().say(PilotSeverity::kNotice,
                     "height 2.1 cm, azimuth unknown: move 10 m sideways, then land");
  ASSERT_TRUE(until([&] { return !bench_->shown().empty(); }));
  EXPECT_EQ(bench_->shown()[0].text, "height 2.1 cm, azimuth unknown: move 10 m");
}

TEST_P(PilotLinkContract, SaysOnceASecondThatItIsThere) {
  connect();
  const std::size_t before = bench_->heartbeats();
  go_on_for(milliseconds(4000), heartbeats_);
  const std::size_t count = bench_->heartbeats() - before;
  EXPECT_GE(count, 3u);  // a machine with much to do may be late, but never early
  EXPECT_LE(count, 5u);
}

TEST_P(PilotLinkContract, DropsTheOldestOfTooManyTextsThatWait) {
  if (!bench_->holds_texts_back()) GTEST_SKIP() << "its texts go out, whoever hears them";
  ASSERT_TRUE(start());
  go_on_for(milliseconds(200));
  for (int i = 0; i < 40; ++i) bench_->link().say(PilotSeverity::kInfo, std::to_string(i));
  bench_->plug_in();
  ASSERT_TRUE(until([&] { return bench_->shown().size() >= 32; }, heartbeats_));
  EXPECT_EQ(bench_->shown().size(), 32u);
  EXPECT_EQ(bench_->shown().front().text, "8");
  EXPECT_EQ(bench_->shown().back().text, "39");
  EXPECT_EQ(bench_->link().counters().texts_dropped, 8u);
}

TEST_P(PilotLinkContract, CountsATextThatNobodyCarries) {
  bench_->link().say(PilotSeverity::kInfo, "before the start");
  EXPECT_EQ(bench_->link().counters().texts_dropped, 1u);
  connect();
  go_on_for(milliseconds(200));
  EXPECT_TRUE(bench_->shown().empty());
}

TEST_P(PilotLinkContract, TakesUpAPortThatWasNotThereAtFirst) {
  if (!bench_->notices_a_pull()) GTEST_SKIP() << "its far end may be silent or not there";
  ASSERT_TRUE(start());
  ASSERT_TRUE(until([&] { return events_.has(PilotState::kAbsent, 0); }));
  EXPECT_EQ(events_.all<PilotReport>()[0].sentence.back(), '.');
  bench_->plug_in();
  EXPECT_TRUE(reports(PilotState::kAutopilot, heartbeats_));
}

TEST_P(PilotLinkContract, IsBackAfterEveryPull) {
  if (!bench_->notices_a_pull()) GTEST_SKIP() << "its far end may be silent or not there";
  ASSERT_TRUE(start());
  ASSERT_TRUE(until([&] { return events_.has(PilotState::kAbsent, 0); }));
  for (int round = 0; round < 20; ++round) {
    bench_->plug_in();
    ASSERT_TRUE(reports(PilotState::kAutopilot, heartbeats_)) << round;
    const std::size_t before = events_.all<PilotReport>().size();
    bench_->pull();
    ASSERT_TRUE(until([&] { return events_.has(PilotState::kAbsent, before); })) << round;
  }
  EXPECT_EQ(bench_->link().counters().reconnections, 19u);
}

TEST_P(PilotLinkContract, SaysThatNothingComes) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  EXPECT_TRUE(reports(PilotState::kSilent));
  EXPECT_TRUE(reports(PilotState::kAutopilot, heartbeats_));
  EXPECT_TRUE(reports(PilotState::kSilent));
}

TEST_P(PilotLinkContract, SaysThatWhatComesCannotBeRead) {
  connect();
  EXPECT_TRUE(reports(PilotState::kGarbled, [this] { bench_->noise(); }));
  EXPECT_TRUE(reports(PilotState::kAutopilot, heartbeats_));
}

TEST_P(PilotLinkContract, SaysThatNoAutopilotIsAmongThoseWhoSpeak) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  EXPECT_TRUE(reports(PilotState::kNoAutopilot, [this] { bench_->ground_station(); }));
  EXPECT_TRUE(events_.all<PilotHeartbeat>().empty());
  EXPECT_TRUE(reports(PilotState::kAutopilot, heartbeats_));
}

TEST_P(PilotLinkContract, IsSilentAfterStopAndStartsAgain) {
  connect();
  bench_->link().stop();
  const std::size_t count = events_.count();
  const std::size_t beats = bench_->heartbeats();
  go_on_for(milliseconds(1500), heartbeats_);
  EXPECT_EQ(events_.count(), count);
  EXPECT_EQ(bench_->heartbeats(), beats);
  ASSERT_TRUE(start());
  EXPECT_TRUE(reports(PilotState::kAutopilot, heartbeats_));
}

TEST_P(PilotLinkContract, RefusesToBeStartedTwice) {
  connect();
  const Status again = start();
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().sentence.back(), '.');
  bench_->link().say(PilotSeverity::kInfo, "still there");
  EXPECT_TRUE(until([&] { return !bench_->shown().empty(); }));
}

}  // namespace plumbline::contract
