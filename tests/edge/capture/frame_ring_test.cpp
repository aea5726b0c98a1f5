// SPDX-License-Identifier: MIT
#include "edge/capture/frame_ring.h"

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <random>

namespace plumbline::capture {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;

HostTime at_ms(double ms) { return HostTime(nanoseconds(std::llround(ms * 1e6))); }

constexpr milliseconds kPeriod{100};

// A camera of 10 frames a second, its frames numbers.
void push(FrameRing<int>& ring, int number, double jitter_ms = 0) {
  ring.push({at_ms(100.0 * number + jitter_ms), kPeriod}, number);
}

TEST(FrameRing, TakesTheFrameBeforeTheInstantWhereItIsNearer) {
  FrameRing<int> ring(2);
  push(ring, 1);
  ring.want(at_ms(130));
  push(ring, 2);
  const auto taken = ring.take(at_ms(210));
  ASSERT_TRUE(taken);
  EXPECT_EQ(taken->second, 1);
  EXPECT_FALSE(ring.is_wanting());
}

TEST(FrameRing, WaitsForTheFrameAfterTheInstantWhereItIsNearer) {
  FrameRing<int> ring(2);
  push(ring, 1);
  ring.want(at_ms(180));
  EXPECT_FALSE(ring.take(at_ms(185)));
  push(ring, 2);
  EXPECT_EQ(ring.take(at_ms(210))->second, 2);
}

TEST(FrameRing, DoesNotWaitWhereTheNextFrameCannotBeNearer) {
  FrameRing<int> ring(2);
  push(ring, 1);
  ring.want(at_ms(105));
  EXPECT_EQ(ring.take(at_ms(110))->second, 1);
}

TEST(FrameRing, KnowsAnInstantThatHasJustGoneBy) {
  FrameRing<int> ring(2);
  for (int i = 0; i <= 5; ++i) push(ring, i);
  ring.want(at_ms(410));
  EXPECT_EQ(ring.take(at_ms(510))->second, 4);
}

TEST(FrameRing, HoldsNoMoreBuffersThanItMust) {
  FrameRing<std::shared_ptr<int>> ring(2);
  const auto buffer = std::make_shared<int>(0);
  for (int i = 0; i < 20; ++i) {
    ring.push({at_ms(100.0 * i), kPeriod}, buffer);
    EXPECT_LE(buffer.use_count(), 3);  // ours and two held
    if (i == 8) ring.want(at_ms(1500));
    if (i > 8) {
      EXPECT_EQ(ring.held(), 1u) << "of what may still come nearer only the nearest";
    }
  }
}

TEST(FrameRing, GivesWhatItHasWhenTheCameraFallsSilent) {
  FrameRing<int> ring(2);
  push(ring, 1);
  ring.want(at_ms(190));
  EXPECT_FALSE(ring.take(at_ms(350)));
  EXPECT_EQ(ring.take(at_ms(401))->second, 1);
}

TEST(FrameRing, GivesNothingWhereNoFrameEverCame) {
  FrameRing<int> ring(2);
  ring.want(at_ms(100));
  EXPECT_FALSE(ring.take(at_ms(100000)));
}

TEST(FrameRing, ForgetsAllWhenCleared) {
  FrameRing<int> ring(2);
  push(ring, 1);
  ring.want(at_ms(100));
  ring.clear();
  EXPECT_EQ(ring.held(), 0u);
  EXPECT_FALSE(ring.take(at_ms(200)));
}

// The nearest of frames that run freely is off by something uniform within half a period.
TEST(FrameRing, IsOffByAPeriodOverTheRootOfTwelve) {
  FrameRing<int> ring(2);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> phase(0, 100);
  std::normal_distribution<double> jitter(0, 1);
  double squares = 0;
  constexpr int kPhotos = 4000;
  int frame = 0;
  for (int photo = 0; photo < kPhotos; ++photo) {
    const double instant_ms = 100.0 * (frame + 3) + phase(random);
    std::optional<std::pair<FrameTime, int>> taken;
    for (bool asked = false; !taken; ++frame) {
      push(ring, frame, jitter(random));
      if (!asked && 100.0 * frame > instant_ms - 250) ring.want(at_ms(instant_ms)), asked = true;
      taken = ring.take(at_ms(100.0 * frame + 10));
    }
    const double off_ms =
        std::chrono::duration<double, std::milli>(taken->first.middle - at_ms(instant_ms)).count();
    EXPECT_LT(std::abs(off_ms), 55.0);
    squares += off_ms * off_ms;
  }
  // Of a uniform distribution the relative deviation of the RMS of n is sqrt(0.8 / n) / 2 = 0.7 %.
  EXPECT_NEAR(std::sqrt(squares / kPhotos), 100 / std::sqrt(12.0), 3 * 0.007 * 28.9);
}

}  // namespace
}  // namespace plumbline::capture
