// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>

#include "edge/capture/release.h"

namespace plumbline::capture {
namespace {

using std::chrono::milliseconds;

HostTime at_ms(int ms) { return HostTime(milliseconds(ms)); }

// A frame of one row, the middle of its exposure at `ms`.
FrameSeen frame_at(int ms, std::uint64_t sequence = 0) {
  FrameSeen frame;
  frame.sequence = sequence;
  frame.timing = {at_ms(ms - 1), milliseconds(2), {}, {}};
  frame.rows = 1;
  return frame;
}

// One pulse and its answer.
void learn(PulseRelease& release, int pulse_ms, int delay_ms) {
  release.pulsed(at_ms(pulse_ms));
  EXPECT_TRUE(release.see(frame_at(pulse_ms + delay_ms)));
}

TEST(PulseRelease, AssumesTheConfiguredDelayBeforeItKnowsBetter) {
  PulseRelease release({});
  EXPECT_EQ(release.delay(), milliseconds(100));
  EXPECT_EQ(release.delay_sigma(), milliseconds(80));
  EXPECT_FALSE(release.is_waiting());
}

// 180, 190 and 200 ms: mean 190, standard deviation 10.
TEST(PulseRelease, LearnsTheDelayAndItsSpread) {
  PulseRelease release({});
  learn(release, 1000, 180);
  learn(release, 2000, 190);
  learn(release, 3000, 200);
  EXPECT_EQ(release.learned_from(), 3);
  EXPECT_NEAR(static_cast<double>(release.delay().count()), 190e6, 2);
  EXPECT_NEAR(static_cast<double>(release.delay_sigma().count()), 10e6, 2);
}

TEST(PulseRelease, FollowsADelayThatDrifts) {
  PulseRelease release({});
  for (int k = 0; k < 20; ++k) learn(release, 1000 * k, 100);
  for (int k = 20; k < 80; ++k) learn(release, 1000 * k, 140);
  // Each of the last 60 took a twelfth of what was left: 40 ms times (11/12)^60 is 0.2 ms.
  EXPECT_NEAR(static_cast<double>(release.delay().count()), 140e6, 0.3e6);
}

TEST(PulseRelease, TakesNoFrameFromBeforeThePulse) {
  PulseRelease release({});
  release.pulsed(at_ms(1000));
  EXPECT_FALSE(release.see(frame_at(990)));
  const auto exposure = release.see(frame_at(1100, 7));
  ASSERT_TRUE(exposure);
  EXPECT_EQ(exposure->frame, 7u);
  EXPECT_EQ(exposure->middle, at_ms(1100));
  EXPECT_FALSE(release.is_waiting());
}

TEST(PulseRelease, MissesWhatDoesNotComeInTime) {
  PulseRelease release({});
  release.pulsed(at_ms(1000));
  EXPECT_EQ(release.due(), at_ms(1800));
  EXPECT_FALSE(release.is_missed(at_ms(1799)));
  EXPECT_FALSE(release.see(frame_at(1801)));
  EXPECT_TRUE(release.is_missed(at_ms(1800)));
  release.give_up();
  EXPECT_FALSE(release.is_waiting());
  EXPECT_EQ(release.due(), HostTime::max());
}

TEST(PulseRelease, TakesTheShutterForTheExposure) {
  PulseRelease release({});
  release.pulsed(at_ms(1000));
  const auto exposure = release.see(ShutterOpened{at_ms(1070)});
  ASSERT_TRUE(exposure);
  EXPECT_EQ(exposure->middle, at_ms(1070));
  EXPECT_FALSE(exposure->frame);
}

// The camera keeps its photos and says nothing: 100 ms as configured, with the sigma of a guess.
TEST(PulseRelease, AssumesTheExposureWhereNothingAnswers) {
  ReleaseOptions options;
  options.is_answered = false;
  PulseRelease release(options);
  release.pulsed(at_ms(1000));
  EXPECT_FALSE(release.assumed(at_ms(1099)));
  const auto exposure = release.assumed(at_ms(1100));
  ASSERT_TRUE(exposure);
  EXPECT_EQ(exposure->middle, at_ms(1100));
  EXPECT_EQ(exposure->sigma, milliseconds(80));
  EXPECT_FALSE(release.is_waiting());
}

}  // namespace
}  // namespace plumbline::capture
