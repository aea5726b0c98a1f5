// SPDX-License-Identifier: MIT
#include "drivers/camera/camera_watch.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

using std::chrono::milliseconds;

HostTime at_ms(int ms) { return HostTime(milliseconds(ms)); }

CameraWatch streaming_since_0(milliseconds period) {
  CameraWatch watch("'x'");
  watch.starting(at_ms(0), period);
  watch.frame(at_ms(0));
  return watch;
}

TEST(CameraWatch, SaysEachChangeOnce) {
  CameraWatch watch("'x'");
  EXPECT_EQ(watch.starting(at_ms(0), milliseconds(100))->state, CameraState::kStarting);
  EXPECT_EQ(watch.frame(at_ms(50))->state, CameraState::kStreaming);
  EXPECT_FALSE(watch.frame(at_ms(150)));
  EXPECT_FALSE(watch.tick(at_ms(1149)));
  EXPECT_EQ(watch.tick(at_ms(1150))->state, CameraState::kStalled);
  EXPECT_FALSE(watch.tick(at_ms(1250)));
  EXPECT_EQ(watch.frame(at_ms(1300))->state, CameraState::kStreaming);
}

TEST(CameraWatch, GivesASlowStreamTwoPeriods) {
  CameraWatch watch = streaming_since_0(milliseconds(800));
  EXPECT_FALSE(watch.tick(at_ms(1599)));
  EXPECT_TRUE(watch.tick(at_ms(1600)));
}

TEST(CameraWatch, CallsAFailureOverOnlyWithAFrame) {
  CameraWatch watch = streaming_since_0(milliseconds(100));
  EXPECT_TRUE(watch.failed(at_ms(100), CameraState::kFailing, "Broken."));
  EXPECT_FALSE(watch.starting(at_ms(200), milliseconds(100)));
  EXPECT_FALSE(watch.tick(at_ms(1300)));
  EXPECT_FALSE(watch.failed(at_ms(1400), CameraState::kFailing, "Broken."));
  EXPECT_EQ(watch.frame(at_ms(1500))->state, CameraState::kStreaming);
}

TEST(CameraWatch, SaysThatACameraThatCameBackIsStarting) {
  CameraWatch watch = streaming_since_0(milliseconds(100));
  EXPECT_TRUE(watch.failed(at_ms(100), CameraState::kAbsent, "Gone."));
  EXPECT_EQ(watch.starting(at_ms(200), milliseconds(100))->state, CameraState::kStarting);
}

TEST(CameraWatch, ReportsDamagedFramesAloneAsAFailure) {
  CameraWatch watch = streaming_since_0(milliseconds(100));
  watch.damaged_frame();
  const auto report = watch.tick(at_ms(1000));
  ASSERT_TRUE(report);
  EXPECT_EQ(report->state, CameraState::kFailing);
}

TEST(CameraWatch, ExcusesSilenceWhileAllBuffersAreLent) {
  CameraWatch watch = streaming_since_0(milliseconds(100));
  watch.excused(at_ms(900));
  EXPECT_FALSE(watch.tick(at_ms(1500)));
  EXPECT_TRUE(watch.tick(at_ms(1900)));
}

TEST(CameraWatch, WantsItOpenedAnewAfterThreeSecondsOrEightAtTheStart) {
  CameraWatch watch = streaming_since_0(milliseconds(100));
  EXPECT_FALSE(watch.is_lost(at_ms(3000)));
  EXPECT_TRUE(watch.is_lost(at_ms(3001)));
  watch.starting(at_ms(10000), milliseconds(100));
  EXPECT_FALSE(watch.is_lost(at_ms(18000)));
  EXPECT_TRUE(watch.is_lost(at_ms(18001)));
}

TEST(CameraWatch, TriesAgainSoonAtFirstAndThenOnceASecond) {
  CameraWatch watch("'x'");
  EXPECT_EQ(watch.next_retry(), milliseconds(50));
  EXPECT_EQ(watch.next_retry(), milliseconds(100));
  for (int i = 0; i < 10; ++i) watch.next_retry();
  EXPECT_EQ(watch.next_retry(), milliseconds(1000));
  watch.frame(at_ms(0));
  EXPECT_EQ(watch.next_retry(), milliseconds(50));
}

}  // namespace
}  // namespace plumbline
