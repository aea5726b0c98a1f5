// SPDX-License-Identifier: MIT
#include "firmware/service/life/progress.h"

#include <gtest/gtest.h>

namespace plumbline::service {
namespace {

using namespace std::chrono_literals;

constexpr HostTime kBegin{100s};

TEST(Progress, CountsTheRoundsOfTheDecidingThread) {
  Progress progress({});
  EXPECT_EQ(progress.state(kBegin, {}).rounds, 0U);
  progress.lived();
  progress.lived();
  EXPECT_EQ(progress.state(kBegin, {}).rounds, 2U);
}

TEST(Progress, DoesNotWantDevicesThatAreNotThere) {
  Progress progress({});
  EXPECT_EQ(progress.state(kBegin + 1h, {}).hangs, "");
}

TEST(Progress, HasACameraStallThatWasSaid) {
  Progress progress({.frame = 30s});
  progress.heard({kBegin, capture::CameraSeen{true}});
  progress.heard({kBegin + 1s, capture::FrameSeen{}});
  progress.heard({kBegin + 2s, capture::CameraSeen{false}});
  EXPECT_EQ(progress.state(kBegin + 1h, {}).hangs, "");
}

TEST(Progress, HasNoneWhereADriverStreamsAndNothingComes) {
  Progress progress({.frame = 30s});
  progress.heard({kBegin, capture::CameraSeen{true}});
  progress.heard({kBegin + 10s, capture::FrameSeen{}});
  EXPECT_EQ(progress.state(kBegin + 39s, {}).hangs, "");
  EXPECT_NE(progress.state(kBegin + 41s, {}).hangs, "");
  progress.heard({kBegin + 42s, capture::FrameSeen{}});
  EXPECT_EQ(progress.state(kBegin + 43s, {}).hangs, "");
}

TEST(Progress, WaitsForNoFramesOfACameraThatKeepsItsPictures) {
  Progress progress({.needs_frames = false, .frame = 30s});
  progress.heard({kBegin, capture::CameraSeen{true}});
  EXPECT_EQ(progress.state(kBegin + 1h, {}).hangs, "");
}

TEST(Progress, HasNoneWhereAPhotoIsEncodedForEver) {
  Progress progress({.encoding = 20s});
  flight::WorkAtHand work;
  work.encoding = kBegin;
  EXPECT_EQ(progress.state(kBegin + 19s, work).hangs, "");
  EXPECT_NE(progress.state(kBegin + 21s, work).hangs, "");
}

// A start anew would lose the photos that wait for it.
TEST(Progress, KnowsOfADiskThatHangsAndGoesOn) {
  Progress progress({.storing = 10s});
  flight::WorkAtHand work;
  work.storing = kBegin;
  EXPECT_FALSE(progress.state(kBegin + 9s, work).disk_is_late);
  const Progress::State late = progress.state(kBegin + 11s, work);
  EXPECT_TRUE(late.disk_is_late);
  EXPECT_EQ(late.hangs, "");
}

}  // namespace
}  // namespace plumbline::service
