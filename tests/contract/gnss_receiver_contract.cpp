// SPDX-License-Identifier: MIT
#include "tests/contract/gnss_receiver_contract.h"

#include <algorithm>
#include <filesystem>

#include "tests/talk/receiver_talk.h"

namespace plumbline::contract {

using std::chrono::milliseconds;
using talk::jumped;
using talk::noise;
using talk::positions;
using talk::was_said;
using talk::without_epochs;
using talk::without_position;

namespace {

constexpr milliseconds kPromised{2000};
constexpr milliseconds kBetweenEpochs{100};

std::ptrdiff_t open_descriptors() {
  const std::filesystem::directory_iterator folder("/proc/self/fd");
  return std::distance(begin(folder), end(folder));
}

}  // namespace

void ReceiverEvents::add(ReceiverEvent event) {
  const std::lock_guard lock(mutex_);
  ++count_;
  if (const auto* bytes = std::get_if<ReceivedBytes>(&event)) bytes_ += bytes->bytes;
  if (const auto* fix = std::get_if<ReceivedFix>(&event)) fixes_.push_back(*fix);
  if (const auto* report = std::get_if<ReceiverReport>(&event)) reports_.push_back(*report);
}

std::vector<ReceivedFix> ReceiverEvents::fixes() const {
  const std::lock_guard lock(mutex_);
  return fixes_;
}

std::vector<ReceiverReport> ReceiverEvents::reports() const {
  const std::lock_guard lock(mutex_);
  return reports_;
}

std::string ReceiverEvents::bytes() const {
  const std::lock_guard lock(mutex_);
  return bytes_;
}

std::size_t ReceiverEvents::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

bool ReceiverEvents::has(ReceiverState state, std::size_t since_report) const {
  const std::lock_guard lock(mutex_);
  const auto from =
      reports_.begin() + static_cast<std::ptrdiff_t>(std::min(since_report, reports_.size()));
  return std::any_of(from, reports_.end(),
                     [state](const ReceiverReport& report) { return report.state == state; });
}

void GnssReceiverContract::SetUp() {
  if (!GetParam().make) GTEST_SKIP() << GetParam().why_not;
  bench_ = GetParam().make();
  next_burst_ = bench_->now();
}

void GnssReceiverContract::TearDown() {
  if (bench_) bench_->receiver().stop();
}

Status GnssReceiverContract::start() {
  return bench_->receiver().start(
      [this](ReceiverEvent event) { bench_->events().add(std::move(event)); });
}

bool GnssReceiverContract::until(const std::function<bool()>& holds, milliseconds at_most,
                                 const Talk& talk) {
  const HostTime end = bench_->now() + at_most;
  while (!holds()) {
    const HostTime now = bench_->now();
    if (now >= end) return false;
    if (now >= next_burst_) {
      if (talk) bench_->send(talk(epoch_));
      ++epoch_;
      next_burst_ = now + kBetweenEpochs;
    }
    bench_->pass(std::min(end, next_burst_) - now);
  }
  return true;
}

void GnssReceiverContract::go_on_for(milliseconds time, const Talk& talk) {
  until([] { return false; }, time, talk);
}

bool GnssReceiverContract::reports(ReceiverState state, const Talk& talk) {
  const std::size_t before = events().reports().size();
  return until([&] { return events().has(state, before); }, kPromised, talk);
}

bool GnssReceiverContract::fix_comes(const Talk& talk) {
  const std::size_t before = events().fixes().size();
  return until([&] { return events().fixes().size() > before; }, kPromised, talk);
}

TEST_P(GnssReceiverContract, HandsOutFixesWithTheArrivalOfTheirFirstAndLastByte) {
  bench_->plug_in();
  const HostTime begin = bench_->now();
  ASSERT_TRUE(start());
  ASSERT_TRUE(until([&] { return events().fixes().size() >= 12; }, milliseconds(5000), positions));
  HostTime before = begin;
  for (const ReceivedFix& fix : events().fixes()) {
    EXPECT_TRUE(was_said(fix.fix));
    EXPECT_GE(fix.first_byte, before);
    EXPECT_GE(fix.last_byte, fix.first_byte);
    EXPECT_LE(fix.last_byte, bench_->now());
    EXPECT_TRUE(fix.fix.covariance_enu_m2);
    before = fix.last_byte;
  }
  EXPECT_TRUE(events().fixes().back().fix.time);
  EXPECT_EQ(events().reports().back().state, ReceiverState::kPosition);
}

TEST_P(GnssReceiverContract, HandsOnEveryByteOnceAndInOrder) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  ASSERT_TRUE(fix_comes(positions));
  go_on_for(milliseconds(100));
  const std::size_t before = events().bytes().size();
  std::string sent;
  const Talk mixed = [&](int epoch) {
    const std::string burst = positions(epoch) + noise(epoch);
    sent += burst;
    return burst;
  };
  go_on_for(milliseconds(500), mixed);
  ASSERT_TRUE(until([&] { return events().bytes().size() >= before + sent.size(); }, kPromised));
  EXPECT_EQ(events().bytes().substr(before), sent);
}

TEST_P(GnssReceiverContract, TakesUpAPortThatWasNotThereAtFirst) {
  ASSERT_TRUE(start());
  ASSERT_TRUE(until([&] { return events().has(ReceiverState::kAbsent); }, kPromised));
  bench_->plug_in();
  EXPECT_TRUE(fix_comes(positions));
}

TEST_P(GnssReceiverContract, SaysThatNothingComes) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  EXPECT_TRUE(reports(ReceiverState::kSilent));
  EXPECT_TRUE(fix_comes(positions));
  EXPECT_EQ(events().reports().back().state, ReceiverState::kPosition);
  EXPECT_TRUE(reports(ReceiverState::kSilent));
}

TEST_P(GnssReceiverContract, SaysThatWhatComesCannotBeRead) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  ASSERT_TRUE(fix_comes(positions));
  EXPECT_TRUE(reports(ReceiverState::kGarbled, noise));
  EXPECT_TRUE(fix_comes(positions));
  EXPECT_EQ(events().reports().back().state, ReceiverState::kPosition);
}

TEST_P(GnssReceiverContract, SaysThatThePositionIsLost) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  ASSERT_TRUE(fix_comes(positions));
  EXPECT_TRUE(reports(ReceiverState::kNoFix, without_position));
  EXPECT_FALSE(events().fixes().back().fix.latitude_deg &&
               events().fixes().back().fix.quality == FixQuality::kNone);
  EXPECT_TRUE(reports(ReceiverState::kPosition, positions));
}

TEST_P(GnssReceiverContract, SaysThatSentencesComeWithoutAnyPosition) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  EXPECT_TRUE(reports(ReceiverState::kNoFix, without_epochs));
  EXPECT_NE(events().reports().back().sentence.find("GGA"), std::string::npos);
}

TEST_P(GnssReceiverContract, SaysThatThePositionJumped) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  ASSERT_TRUE(fix_comes(positions));
  EXPECT_TRUE(reports(ReceiverState::kJumped, jumped));
  EXPECT_NE(events().reports().back().sentence.find("100.0 m"), std::string::npos)
      << events().reports().back().sentence;
  EXPECT_TRUE(reports(ReceiverState::kPosition, jumped));
  EXPECT_TRUE(reports(ReceiverState::kJumped, positions));
}

TEST_P(GnssReceiverContract, LosesOnlyTheSentenceWithAFlippedByte) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  ASSERT_TRUE(fix_comes(positions));
  const Talk damaged = [](int epoch) {
    std::string burst = positions(epoch);
    const std::size_t at = static_cast<std::size_t>(epoch * 7) % burst.size();
    burst[at] = static_cast<char>(burst[at] ^ 4);
    return burst;
  };
  go_on_for(milliseconds(3000), damaged);
  ASSERT_TRUE(fix_comes(positions));
  for (const ReceivedFix& fix : events().fixes()) {
    EXPECT_TRUE(was_said(fix.fix));
  }
  EXPECT_GT(events().fixes().size(), 8u);
  const ReceiverCounters counters = bench_->receiver().counters();
  EXPECT_GT(counters.bad_checksum, 10u);
}

TEST_P(GnssReceiverContract, IsBackWithinTwoSecondsOfEachOfFiftyReturns) {
  sim::Random random(20261120, 50);
  const auto random_time = [&] { return milliseconds(static_cast<int>(random.uniform(0, 150))); };
  const std::ptrdiff_t descriptors = open_descriptors();
  ASSERT_TRUE(start());
  for (int round = 0; round < 50; ++round) {
    bench_->plug_in();
    ASSERT_TRUE(fix_comes(positions)) << round;
    go_on_for(random_time(), positions);
    const std::string burst = positions(epoch_++);
    bench_->send(burst.substr(0, static_cast<std::size_t>(random.uniform() * 200)));
    const std::size_t before = events().reports().size();  // a pull may take longer than its report
    bench_->pull();
    ASSERT_TRUE(until([&] { return events().has(ReceiverState::kAbsent, before); }, kPromised))
        << round;
    go_on_for(random_time());
  }
  EXPECT_EQ(bench_->receiver().counters().reconnections, 49u);
  for (const ReceivedFix& fix : events().fixes()) EXPECT_TRUE(was_said(fix.fix));
  EXPECT_FALSE(events().has(ReceiverState::kJumped));
  bench_->receiver().stop();
  EXPECT_EQ(open_descriptors(), descriptors);
}

TEST_P(GnssReceiverContract, IsSilentAfterStopAndStartsAgain) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  ASSERT_TRUE(fix_comes(positions));
  bench_->receiver().stop();
  const std::size_t count = events().count();
  go_on_for(milliseconds(300), positions);
  EXPECT_EQ(events().count(), count);
  ASSERT_TRUE(start());
  EXPECT_TRUE(fix_comes(positions));
}

TEST_P(GnssReceiverContract, RefusesToBeStartedTwice) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  const Status again = start();
  ASSERT_FALSE(again);
  EXPECT_EQ(again.error().sentence.back(), '.');
  EXPECT_TRUE(fix_comes(positions));
}

TEST_P(GnssReceiverContract, CountsWhatPassed) {
  bench_->plug_in();
  ASSERT_TRUE(start());
  ASSERT_TRUE(until([&] { return events().fixes().size() >= 5; }, milliseconds(5000), positions));
  go_on_for(milliseconds(100));
  const ReceiverCounters counters = bench_->receiver().counters();
  EXPECT_EQ(counters.bytes, events().bytes().size());
  EXPECT_EQ(counters.epochs, events().fixes().size());
  EXPECT_GE(counters.sentences, 2 * counters.epochs);
  EXPECT_EQ(counters.reconnections, 0u);
}

}  // namespace plumbline::contract
