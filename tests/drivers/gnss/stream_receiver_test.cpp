// SPDX-License-Identifier: MIT
#include "drivers/gnss/stream_receiver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <condition_variable>

#include "edge/gnss/stream_decoder.h"
#include "tests/talk/receiver_talk.h"

namespace plumbline::gnss_driver {
namespace {

using std::chrono::milliseconds;
using testing::HasSubstr;

// Goes on when a line is read from: tests wait for nothing.
class StepClock : public Clock {
 public:
  HostTime now() const override { return HostTime(milliseconds(ms_)); }
  WallReading wall() const override { return {}; }
  bool wait(Signal&, HostTime) override { return false; }
  void go_on(int ms) { ms_ += ms; }

 private:
  std::atomic<int> ms_ = 0;
};

// A serial line at one speed: at any other it gives noise.
class Line : public ByteStream {
 public:
  Line(StepClock& clock, int baud, int bursts) : clock_(clock), baud_(baud), bursts_(bursts) {}

  Opening open() override { return refusal_.empty() ? Opening{} : Opening{refused(), refusal_}; }
  Reading read(std::chrono::nanoseconds /*at_most*/) override {
    clock_.go_on(100);
    if (epoch_ == bursts_) return {Arrival::kEnd, {}, "The line has ended."};
    const int epoch = epoch_++;
    burst_ = speed_ == baud_ ? talk::positions(epoch) : talk::noise(epoch);
    return {Arrival::kBytes, burst_, {}};
  }
  void close() override {}
  void pause(std::chrono::nanoseconds /*time*/) override {}
  void interrupt() override {}
  std::vector<int> speeds() const override { return {115200, 38400, 9600}; }
  Status set_speed(int baud) override {
    speed_ = baud;
    return Done{};
  }
  std::string name() const override { return "line"; }

  void refuse(std::string sentence) { refusal_ = std::move(sentence); }

 private:
  static Presence refused() { return Presence::kRefused; }

  StepClock& clock_;
  int baud_;
  int bursts_;
  int speed_ = 0;
  int epoch_ = 0;
  std::string burst_;
  std::string refusal_;
};

struct Heard {
  std::mutex mutex;
  std::condition_variable ended;
  std::vector<ReceivedFix> fixes;
  std::vector<ReceiverReport> reports;

  void add(const ReceiverEvent& event) {
    const std::lock_guard lock(mutex);
    if (const auto* fix = std::get_if<ReceivedFix>(&event)) fixes.push_back(*fix);
    if (const auto* report = std::get_if<ReceiverReport>(&event)) reports.push_back(*report);
    ended.notify_all();
  }
  void wait_for_end() {
    std::unique_lock lock(mutex);
    ended.wait_for(lock, std::chrono::seconds(60), [this] {
      return !reports.empty() && reports.back().state == ReceiverState::kAbsent;
    });
  }
};

TEST(StreamReceiver, FindsTheSpeedOfTheLineAndRemembersIt) {
  StepClock clock;
  StreamReceiver receiver(std::make_unique<Line>(clock, 9600, 100), gnss::make_fix_decoder, clock);
  EXPECT_EQ(receiver.name(), "line");
  Heard heard;
  ASSERT_TRUE(receiver.start([&](const ReceiverEvent& event) { heard.add(event); }));
  heard.wait_for_end();
  receiver.stop();
  EXPECT_GT(heard.fixes.size(), 50u);
  for (const ReceivedFix& fix : heard.fixes) EXPECT_TRUE(talk::was_said(fix.fix));
  EXPECT_EQ(receiver.name(), "line at 9600 baud");
  ASSERT_TRUE(receiver.start([](const ReceiverEvent&) {}));
  EXPECT_EQ(receiver.name(), "line at 9600 baud");
}

TEST(StreamReceiver, KeepsASpeedThatItWasGivenAndSaysThatNothingCanBeRead) {
  StepClock clock;
  StreamReceiver receiver(std::make_unique<Line>(clock, 9600, 100), gnss::make_fix_decoder, clock,
                          {.baud = 38400});
  Heard heard;
  ASSERT_TRUE(receiver.start([&](const ReceiverEvent& event) { heard.add(event); }));
  heard.wait_for_end();
  EXPECT_TRUE(heard.fixes.empty());
  ASSERT_EQ(heard.reports.size(), 2u);
  EXPECT_EQ(heard.reports[0].state, ReceiverState::kGarbled);
  EXPECT_LE(heard.reports[0].time, HostTime(milliseconds(2000)));
  EXPECT_THAT(heard.reports[0].sentence, HasSubstr("line at 38400 baud"));
}

TEST(StreamReceiver, FailsToStartWhereWaitingCannotHelp) {
  StepClock clock;
  auto line = std::make_unique<Line>(clock, 9600, 1);
  line->refuse("line may not be opened.");
  StreamReceiver receiver(std::move(line), gnss::make_fix_decoder, clock);
  const Status started = receiver.start([](const ReceiverEvent&) {});
  ASSERT_FALSE(started);
  EXPECT_EQ(started.error().sentence, "line may not be opened.");
  receiver.stop();
}

}  // namespace
}  // namespace plumbline::gnss_driver
