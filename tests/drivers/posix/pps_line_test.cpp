// SPDX-License-Identifier: MIT
#include "drivers/posix/pps_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <optional>
#include <utility>

#include "drivers/event_queue.h"
#include "drivers/posix/system_clock.h"

namespace plumbline::posix {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

constexpr auto kCalendar = std::chrono::sys_days{std::chrono::year{2026} / 5 / 1};

WallReading reading(std::chrono::nanoseconds host, std::chrono::nanoseconds wall_ahead = 0ns) {
  return {HostTime(host), WallTime(kCalendar) + host + wall_ahead, 2us};
}

TEST(PpsStamp, IsTurnedIntoHostTimeByTheReadingsAroundIt) {
  const auto time =
      host_time_of(WallTime(kCalendar) + 10s + 50ms, reading(10s), reading(10s + 60ms));
  ASSERT_TRUE(time.has_value());
  EXPECT_EQ(*time, HostTime(10s + 50ms));
}

TEST(PpsStamp, FollowsAWallClockThatIsSlewed) {
  const auto time =
      host_time_of(WallTime(kCalendar) + 10s + 50ms, reading(10s), reading(10s + 60ms, 20us));
  ASSERT_TRUE(time.has_value());
  EXPECT_EQ(*time, HostTime(10s + 50ms - 20us));
}

TEST(PpsStamp, IsDroppedAcrossAStepOfTheWallClock) {
  for (const auto step : {1ms, 3600000ms, -1ms}) {
    const WallTime stamp = WallTime(kCalendar) + 10s + 50ms;
    EXPECT_FALSE(host_time_of(stamp, reading(10s), reading(10s + 60ms, step)).has_value());
  }
}

TEST(PpsStamp, IsDroppedWhereItDoesNotLieBetweenTheReadings) {
  EXPECT_FALSE(host_time_of(WallTime(kCalendar) + 9s, reading(10s), reading(10s + 60ms)));
  EXPECT_FALSE(host_time_of(WallTime(kCalendar) + 11s, reading(10s), reading(10s + 60ms)));
}

// A device that counts and stamps, when the line looks, what the test told it to. Shared with the
// test, which outlives the line.
class MadePulses {
 public:
  explicit MadePulses(const Clock& clock) : clock_(clock) {}

  void pulse(std::uint32_t count = 1, std::chrono::nanoseconds stamp_error = 0ns) {
    push([this, count, stamp_error]() -> Result<PpsCount> {
      return last_ = {last_.pulses + count, clock_.wall().wall + stamp_error};
    });
  }
  void take_away() {
    push([]() -> Result<PpsCount> { return Error{"Gone."}; });
  }

  Result<PpsCount> wait(std::chrono::nanoseconds at_most) {
    std::unique_lock lock(mutex_);
    if (!changed_.wait_for(lock, at_most, [this] { return !steps_.empty(); })) return last_;
    const auto step = std::move(steps_.front());
    steps_.pop_front();
    return step();
  }

 private:
  using Step = std::function<Result<PpsCount>()>;

  void push(Step step) {
    {
      const std::lock_guard lock(mutex_);
      steps_.push_back(std::move(step));
    }
    changed_.notify_one();
  }

  const Clock& clock_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<Step> steps_;
  PpsCount last_{4294967294, {}};  // it soon wraps
};

class MadeSource : public PpsSource {
 public:
  explicit MadeSource(MadePulses& pulses) : pulses_(pulses) {}
  Result<PpsCount> wait(std::chrono::nanoseconds at_most) override { return pulses_.wait(at_most); }

 private:
  MadePulses& pulses_;
};

class PpsLineTest : public ::testing::Test {
 protected:
  void listen() {
    const Status listening = line_->listen([this](LineEvent event) { events_.push(event); });
    ASSERT_TRUE(listening.ok());
  }
  // Of the type that is expected; waits for it.
  template <typename Event>
  Event next() {
    std::optional<LineEvent> event = events_.pop();
    while (!event && clock_.wait(signal_, clock_.now() + 30s)) event = events_.pop();
    const Event* expected = event ? std::get_if<Event>(&*event) : nullptr;
    EXPECT_NE(expected, nullptr);
    return expected != nullptr ? *expected : Event{};
  }

  SystemClock clock_;
  Signal signal_;
  EventQueue<LineEvent> events_{signal_};
  MadePulses pulses_{clock_};
  std::unique_ptr<TriggerLine> line_ = make_pps_line(std::make_unique<MadeSource>(pulses_), clock_);
};

TEST_F(PpsLineTest, GivesEachPulseAsARisingEdgeOfTheHostsTime) {
  listen();
  for (std::uint64_t i = 0; i < 4; ++i) {
    const HostTime before = clock_.now();
    pulses_.pulse();
    const auto edge = next<LineEdge>();
    const HostTime after = clock_.now();
    EXPECT_TRUE(edge.rising);
    EXPECT_EQ(edge.sequence, i);
    EXPECT_GE(edge.time, before - 1ms);  // the wall clock may be slewed meanwhile
    EXPECT_LE(edge.time, after + 1ms);
  }
}

TEST_F(PpsLineTest, CountsPulsesOfWhichOnlyTheLastIsKnown) {
  listen();
  pulses_.pulse(3);
  EXPECT_EQ(next<EdgesLost>().count, 2u);
  EXPECT_EQ(next<LineEdge>().sequence, 2u);
}

TEST_F(PpsLineTest, CountsAPulseWithAnImpossibleStampAsLost) {
  listen();
  pulses_.pulse(1, 1h);
  pulses_.pulse();
  EXPECT_EQ(next<EdgesLost>().count, 1u);
  EXPECT_EQ(next<LineEdge>().sequence, 1u);
}

TEST_F(PpsLineTest, SaysThatTheDeviceIsGone) {
  listen();
  pulses_.take_away();
  EXPECT_EQ(next<LineFault>().sentence, "Gone.");
}

TEST_F(PpsLineTest, IsListenedToByOneAtATimeAndAgainAfterStop) {
  listen();
  EXPECT_FALSE(line_->listen([](const LineEvent&) {}).ok());
  line_->stop();
  listen();
  pulses_.pulse();
  next<LineEdge>();
}

TEST_F(PpsLineTest, HasNoOutput) {
  EXPECT_THAT(line_->pulse().error().sentence, HasSubstr("no output"));
}

TEST(PpsDevice, SaysWhatIsWrongWithWhatWasNamed) {
  const SystemClock clock;
  EXPECT_EQ(open_pps_line("/dev/pps-none", clock).error().sentence,
            "Cannot open '/dev/pps-none': it is not there; load the driver of the pulse (pps-gpio, "
            "pps-ldisc) or connect it.");
  EXPECT_THAT(open_pps_line("/dev/null", clock).error().sentence, HasSubstr("not a PPS device"));
}

}  // namespace
}  // namespace plumbline::posix
