// SPDX-License-Identifier: MIT
#include "sim/virtual_clock.h"

#include <gtest/gtest.h>

#include <string>

namespace plumbline::sim {
namespace {

using namespace std::chrono_literals;

TEST(VirtualClock, StandsStillWhileCodeRuns) {
  const VirtualClock clock(HostTime(5s));
  EXPECT_EQ(clock.now(), HostTime(5s));
  EXPECT_EQ(clock.now(), HostTime(5s));
}

TEST(VirtualClock, JumpsToTheDeadlineWhereNothingHappens) {
  VirtualClock clock;
  Signal signal;
  EXPECT_FALSE(clock.wait(signal, HostTime(24h)));
  EXPECT_EQ(clock.now(), HostTime(24h));
}

TEST(VirtualClock, StopsAtTheActionThatRaisesTheSignal) {
  VirtualClock clock;
  Signal signal;
  clock.at(HostTime(2s), [&] { signal.raise(); });
  clock.at(HostTime(1s), [] {});
  EXPECT_TRUE(clock.wait(signal, HostTime(10s)));
  EXPECT_EQ(clock.now(), HostTime(2s));
}

TEST(VirtualClock, RunsActionsByTimeThenInTheOrderOfAsking) {
  VirtualClock clock;
  std::string order;
  clock.at(HostTime(2s), [&] { order += 'c'; });
  clock.at(HostTime(1s), [&] { order += 'a'; });
  clock.at(HostTime(2s), [&] { order += 'd'; });
  clock.at(HostTime(1s), [&] {
    order += 'b';
    clock.after(0s, [&] { order += '+'; });
  });
  clock.run_until(HostTime(2s));
  EXPECT_EQ(order, "ab+cd");
}

TEST(VirtualClock, LeavesActionsBeyondTheDeadlineForLater) {
  VirtualClock clock;
  Signal signal;
  clock.at(HostTime(3s), [&] { signal.raise(); });
  EXPECT_FALSE(clock.wait(signal, HostTime(2s)));
  EXPECT_EQ(clock.now(), HostTime(2s));
  EXPECT_TRUE(clock.wait(signal, HostTime(4s)));
}

TEST(VirtualClock, NeverRunsBackwards) {
  VirtualClock clock(HostTime(10s));
  Signal signal;
  HostTime seen{};
  clock.at(HostTime(1s), [&] { seen = clock.now(); });
  EXPECT_FALSE(clock.wait(signal, HostTime(5s)));
  EXPECT_EQ(clock.now(), HostTime(10s));
  clock.run_until(HostTime(10s));
  EXPECT_EQ(seen, HostTime(10s));
}

TEST(VirtualClock, ASetCalendarLeavesTheHostTimeAlone) {
  VirtualClock clock(HostTime(1s), WallTime(100s));
  clock.step_wall(1h);
  clock.run_until(HostTime(3s));
  EXPECT_EQ(clock.wall().host, HostTime(3s));
  EXPECT_EQ(clock.wall().wall, WallTime(102s + 1h));
}

}  // namespace
}  // namespace plumbline::sim
