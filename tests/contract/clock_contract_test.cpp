// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>
#include <time.h>

#include <functional>
#include <memory>
#include <string>
#include <thread>

#include "drivers/clock.h"
#include "drivers/posix/system_clock.h"
#include "sim/virtual_clock.h"

namespace plumbline::contract {
namespace {

using namespace std::chrono_literals;

struct ClockMaker {
  std::string name;
  std::function<std::unique_ptr<Clock>()> make;
};
void PrintTo(const ClockMaker& maker, std::ostream* out) { *out << maker.name; }

// What drivers/clock.h promises.
class ClockContract : public ::testing::TestWithParam<ClockMaker> {
 protected:
  std::unique_ptr<Clock> clock_ = GetParam().make();
};

TEST_P(ClockContract, NeverRunsBackwards) {
  HostTime last = clock_->now();
  for (int i = 0; i < 1000; ++i) {
    const HostTime now = clock_->now();
    ASSERT_GE(now, last);
    last = now;
  }
}

TEST_P(ClockContract, WaitsUntilTheDeadlineAndNotLess) {
  Signal signal;
  const HostTime deadline = clock_->now() + 20ms;
  EXPECT_FALSE(clock_->wait(signal, deadline));
  EXPECT_GE(clock_->now(), deadline);
}

TEST_P(ClockContract, ReturnsAtOnceWhereTheSignalWasRaisedBefore) {
  Signal signal;
  signal.raise();
  signal.raise();
  const HostTime far = clock_->now() + 1h;
  EXPECT_TRUE(clock_->wait(signal, far));
  EXPECT_LT(clock_->now(), far);
  EXPECT_FALSE(signal.take());
}

TEST_P(ClockContract, ReturnsAtOnceWhereTheDeadlineIsPast) {
  Signal signal;
  EXPECT_FALSE(clock_->wait(signal, clock_->now() - 1s));
}

TEST_P(ClockContract, ReadsBothClocksWithinTheSpreadItStates) {
  const HostTime before = clock_->now();
  const WallReading reading = clock_->wall();
  EXPECT_GE(reading.host, before);
  EXPECT_LE(reading.host, clock_->now());
  EXPECT_GE(reading.spread, 0ns);
  const WallReading later = clock_->wall();
  const auto drift = (later.wall - reading.wall) - (later.host - reading.host);
  EXPECT_LE(std::chrono::abs(drift), reading.spread + later.spread + 1ms);
}

INSTANTIATE_TEST_SUITE_P(
    Clocks, ClockContract,
    ::testing::Values(ClockMaker{"System", [] { return std::make_unique<posix::SystemClock>(); }},
                      ClockMaker{"Virtual",
                                 [] { return std::make_unique<sim::VirtualClock>(HostTime(1h)); }}),
    [](const auto& info) { return info.param.name; });

TEST(SystemClock, IsTheMonotonicClockOfTheKernel) {
  const posix::SystemClock clock;
  timespec kernel{};
  const HostTime before = clock.now();
  ASSERT_EQ(::clock_gettime(CLOCK_MONOTONIC, &kernel), 0);
  const HostTime after = clock.now();
  const HostTime between(std::chrono::seconds(kernel.tv_sec) +
                         std::chrono::nanoseconds(kernel.tv_nsec));
  EXPECT_LE(before, between);
  EXPECT_LE(between, after);
}

TEST(SystemClock, IsWokenFromAnotherThread) {
  posix::SystemClock clock;
  Signal signal;
  std::thread other([&] { signal.raise(); });
  EXPECT_TRUE(clock.wait(signal, clock.now() + 10s));
  other.join();
}

}  // namespace
}  // namespace plumbline::contract
