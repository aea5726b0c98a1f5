// SPDX-License-Identifier: MIT
#include "edge/timing/wall_pair.h"

#include <gtest/gtest.h>

namespace plumbline::timing {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

const HostTime kHostStart{seconds(900)};

TEST(WallPair, CarriesAStampOverFromTheWallClock) {
  // The wall clock gains 40 us in a second: by hand, 10 us after a quarter.
  const WallTime wall{seconds(1700000000)};
  const WallReading before{kHostStart, wall, microseconds(2)};
  const WallReading after{kHostStart + seconds(1), wall + seconds(1) + microseconds(40),
                          microseconds(2)};
  const auto stamp = host_of_wall(wall + milliseconds(250) + microseconds(10), before, after);
  ASSERT_TRUE(stamp);
  EXPECT_EQ(stamp->time, kHostStart + milliseconds(250));
  EXPECT_LT(stamp->sigma, microseconds(20));
}

TEST(WallPair, DropsAStampAcrossAStepOfTheWallClock) {
  const WallTime wall{seconds(1700000000)};
  const WallReading before{kHostStart, wall, microseconds(2)};
  for (const auto step : {nanoseconds(milliseconds(-2)), nanoseconds(milliseconds(2)),
                          nanoseconds(seconds(86400)), nanoseconds(seconds(-86400))}) {
    const WallReading after{kHostStart + seconds(1), wall + seconds(1) + step, microseconds(2)};
    EXPECT_FALSE(host_of_wall(wall + milliseconds(250), before, after)) << step.count();
  }
}

TEST(WallPair, DropsAStampThatIsNotBetween) {
  const WallTime wall{seconds(1700000000)};
  const WallReading before{kHostStart, wall, microseconds(2)};
  const WallReading after{kHostStart + seconds(1), wall + seconds(1), microseconds(2)};
  EXPECT_FALSE(host_of_wall(wall - nanoseconds(1), before, after));
  EXPECT_FALSE(host_of_wall(wall + seconds(1) + nanoseconds(1), before, after));
}

}  // namespace
}  // namespace plumbline::timing
