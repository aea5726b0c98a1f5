// SPDX-License-Identifier: MIT
#include "edge/timing/crossing.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/edge/timing/simulated_climb.h"

namespace plumbline::timing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// Five fixes a second for ten seconds, without noise, of an antenna that goes evenly.
AntennaPredictor seen_going(const Eigen::Vector3d& velocity_m_s) {
  AntennaPredictor antenna;
  for (int k = 0; k <= 50; ++k) {
    antenna.add(fix_at(0.2 * k, 0.2 * k * velocity_m_s, {0.01, 0.01, 0.02}));
  }
  return antenna;
}

const GpsTime kNewest = kGpsStart + seconds(10);

TEST(Crossing, OfAHeightIsWhereAnEvenClimbReachesIt) {
  // 30 m after 10 s, so 30.9 m after 10.3 s; the frame's origin is at 50 m.
  const auto crossing =
      crossing_of_height(seen_going({0, 0, 3}), 50 + 30.9, kNewest, milliseconds(500));
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(as_seconds(crossing->time - kNewest), 0.3, 0.002);
  EXPECT_NEAR(crossing->speed_m_s, 3, 0.02);
}

TEST(Crossing, OfAHeightMayBeDownwards) {
  const auto crossing =
      crossing_of_height(seen_going({0, 0, -2}), 50 - 20.8, kNewest, milliseconds(500));
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(as_seconds(crossing->time - kNewest), 0.4, 0.002);
  EXPECT_NEAR(crossing->speed_m_s, -2, 0.02);
}

TEST(Crossing, OfADistanceIsWhereTheAntennaHasGoneSoFar) {
  // 5 m/s at 3, 4 in plan, climbing: 50 m after 10 s.
  const auto crossing = crossing_of_distance(seen_going({3, 4, 2}), {35.6, 139.7, 50}, 51.5,
                                             kNewest, milliseconds(500));
  ASSERT_TRUE(crossing);
  EXPECT_NEAR(as_seconds(crossing->time - kNewest), 0.3, 0.002);
  EXPECT_NEAR(crossing->speed_m_s, 5, 0.02);
}

TEST(Crossing, IsEmptyWhenItIsTooFarOffOrPast) {
  const AntennaPredictor antenna = seen_going({0, 0, 3});
  EXPECT_FALSE(crossing_of_height(antenna, 50 + 33, kNewest, milliseconds(500)));
  EXPECT_FALSE(crossing_of_height(antenna, 50 + 29, kNewest, milliseconds(500)));
  // The predictor sees two seconds ahead, whatever is asked for.
  EXPECT_FALSE(crossing_of_height(antenna, 50 + 60, kNewest, seconds(30)));
}

TEST(Crossing, IsEmptyWhenNothingIsKnownOrNothingMoves) {
  EXPECT_FALSE(crossing_of_height(AntennaPredictor(), 80, kNewest, seconds(1)));
  EXPECT_FALSE(crossing_of_height(seen_going({0, 0, 0}), 50.5, kNewest, seconds(1)));
  EXPECT_FALSE(
      crossing_of_distance(seen_going({1, 0, 0}), {91, 139.7, 50}, 10.1, kNewest, seconds(1)));
}

TEST(Crossing, OnTheHostsClockHasTheClocksSigmaToo) {
  GnssClock clock;
  clock.host = kHostStart;
  clock.gps = kGpsStart;
  clock.variance_s2 = 4e-6;  // 2 ms, and 1.5 ms: 2.5 ms
  clock.sigma_latency = milliseconds(30);
  const Crossing crossing{kGpsStart + milliseconds(250), std::chrono::microseconds(1500), 3};
  const auto host = on_host(crossing, clock);
  EXPECT_EQ(host.time, kHostStart + milliseconds(250));
  EXPECT_NEAR(as_seconds(host.sigma_fit), 2.5e-3, 1e-9);
  EXPECT_EQ(host.sigma_latency, milliseconds(30));
}

}  // namespace
}  // namespace plumbline::timing
