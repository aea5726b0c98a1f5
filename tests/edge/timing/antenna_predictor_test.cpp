// SPDX-License-Identifier: MIT
#include "edge/timing/antenna_predictor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/edge/timing/simulated_climb.h"

namespace plumbline::timing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

const Eigen::Vector3d kSigma_m{0.01, 0.01, 0.02};

// Straight up at 3 m/s, without errors, 5 Hz.
AntennaPredictor steady_climb(double duration_s) {
  AntennaPredictor predictor;
  for (double t_s = 0; t_s < duration_s - 0.01; t_s += 0.2) {
    predictor.add(fix_at(t_s, {0, 0, 3 * t_s}, kSigma_m));
  }
  return predictor;
}

GpsTime gps_at(double t_s) { return kGpsStart + of_seconds(t_s); }

Eigen::Vector3d enu_of(const PredictedAntenna& antenna) {
  return climb_frame().enu_of(antenna.position);
}

TEST(AntennaPredictor, HasNothingToSayBeforeTheFirstPosition) {
  AntennaPredictor predictor;
  EXPECT_FALSE(predictor.at(kGpsStart));
  GnssFix fix;
  fix.time = gnss::utc_of(kGpsStart);
  EXPECT_FALSE(predictor.add(fix));
  EXPECT_FALSE(predictor.at(kGpsStart));
  EXPECT_EQ(predictor.summary().no_position, 1u);
}

TEST(AntennaPredictor, GoesOnAsTheClimbDid) {
  const AntennaPredictor predictor = steady_climb(20);
  const auto antenna = predictor.at(gps_at(20.2));
  ASSERT_TRUE(antenna);
  EXPECT_EQ(antenna->ahead, milliseconds(400));
  EXPECT_NEAR(enu_of(*antenna).z(), 60.6, 0.002);
  EXPECT_NEAR(antenna->velocity_enu_m_s.z(), 3, 0.01);
  EXPECT_EQ(antenna->quality, FixQuality::kFixed);
}

TEST(AntennaPredictor, GrowsLessCertainTheFurtherAhead) {
  const AntennaPredictor predictor = steady_climb(20);
  double before_m2 = predictor.at(gps_at(19.7))->covariance_enu_m2(2, 2);
  for (const double t_s : {19.8, 20.0, 20.3, 20.8, 21.7}) {
    const double now_m2 = predictor.at(gps_at(t_s))->covariance_enu_m2(2, 2);
    EXPECT_GT(now_m2, before_m2) << t_s;
    before_m2 = now_m2;
  }
  EXPECT_FALSE(predictor.at(gps_at(21.9)));
}

TEST(AntennaPredictor, DoesNotAverageAwayWhatNeighbouringEpochsShare) {
  const AntennaPredictor predictor = steady_climb(20);
  EXPECT_GT(predictor.at(gps_at(15))->covariance_enu_m2(2, 2), 0.8 * 0.02 * 0.02);
}

TEST(AntennaPredictor, AddsTheClocksSigmaTimesSpeedAndKeepsTheLatencyApart) {
  const AntennaPredictor predictor = steady_climb(20);
  GnssClock clock;
  clock.host = kHostStart;
  clock.gps = kGpsStart;
  clock.variance_s2 = 0.01 * 0.01;
  clock.sigma_latency = milliseconds(30);
  const auto bare = predictor.at(gps_at(19));
  const auto antenna = predictor.at(kHostStart + seconds(19), clock);
  ASSERT_TRUE(antenna);
  EXPECT_EQ(antenna->time, gps_at(19));
  // 10 ms at 3 m/s are 3 cm, 30 ms 9 cm.
  EXPECT_NEAR(antenna->covariance_enu_m2(2, 2) - bare->covariance_enu_m2(2, 2), 0.03 * 0.03, 1e-5);
  EXPECT_NEAR(antenna->latency_shift_enu_m.z(), 0.09, 1e-3);
}

TEST(AntennaPredictor, KeepsTheVelocityAcrossAChangeOfQuality) {
  AntennaPredictor predictor = steady_climb(20);
  GnssFix fix = fix_at(20, {0.4, -0.3, 60.7}, {0.3, 0.3, 0.6});
  fix.quality = FixQuality::kFloat;
  ASSERT_TRUE(predictor.add(fix));
  const auto antenna = predictor.at(gps_at(20.2));
  EXPECT_EQ(antenna->quality, FixQuality::kFloat);
  EXPECT_NEAR(antenna->velocity_enu_m_s.z(), 3, 0.1);
  EXPECT_GT(antenna->covariance_enu_m2(2, 2), 0.3);
  EXPECT_EQ(predictor.summary().restarts, 0u);
}

TEST(AntennaPredictor, LeavesOutOneWildFixButFollowsThree) {
  AntennaPredictor predictor = steady_climb(20);
  EXPECT_FALSE(predictor.add(fix_at(20, {8, 0, 60}, kSigma_m)));
  EXPECT_TRUE(predictor.add(fix_at(20.2, {0, 0, 60.6}, kSigma_m)));
  EXPECT_NEAR(enu_of(*predictor.at(gps_at(20.2))).x(), 0, 0.01);
  EXPECT_FALSE(predictor.add(fix_at(20.4, {8, 0, 61.2}, kSigma_m)));
  EXPECT_FALSE(predictor.add(fix_at(20.6, {8, 0, 61.8}, kSigma_m)));
  EXPECT_TRUE(predictor.add(fix_at(20.8, {8, 0, 62.4}, kSigma_m)));
  EXPECT_NEAR(enu_of(*predictor.at(gps_at(20.8))).x(), 8, 0.01);
  EXPECT_EQ(predictor.summary().outliers, 3u);
  EXPECT_EQ(predictor.summary().restarts, 1u);
}

// Up at 3 m/s; from second 20 on 4 m/s2 downwards for a second, then as much upwards.
double bobbing_m(double t_s) {
  const double down_s = std::clamp(t_s - 20, 0.0, 1.0), up_s = std::clamp(t_s - 21, 0.0, 1.0);
  return 3 * t_s - 2 * down_s * down_s - 4 * (std::max(t_s, 21.0) - 21) + 2 * up_s * up_s +
         4 * (std::max(t_s, 22.0) - 22);
}

TEST(AntennaPredictor, FollowsAPilotWhoTurnsBackAndOnAgain) {
  for (const double step_s : {0.1, 0.2, 1.0}) {
    AntennaPredictor predictor;
    for (int k = 0; step_s * k < 30; ++k) {
      EXPECT_TRUE(predictor.add(fix_at(step_s * k, {0, 0, bobbing_m(step_s * k)}, kSigma_m)));
    }
    EXPECT_EQ(predictor.summary().outliers, 0u) << step_s;
    EXPECT_EQ(predictor.summary().restarts, 0u) << step_s;
    const auto after = predictor.at(gps_at(29.9));
    EXPECT_NEAR(enu_of(*after).z(), bobbing_m(29.9), 0.05) << step_s;
  }
}

TEST(AntennaPredictor, LeavesOutRepeatedAndOlderEpochs) {
  AntennaPredictor predictor = steady_climb(20);
  EXPECT_FALSE(predictor.add(fix_at(19.8, {0, 0, 59.4}, kSigma_m)));
  EXPECT_FALSE(predictor.add(fix_at(19.0, {0, 0, 57}, kSigma_m)));
  EXPECT_EQ(predictor.summary().repeated, 2u);
}

TEST(AntennaPredictor, SaysNothingInAGapAndBeginsAnewAfterIt) {
  AntennaPredictor predictor = steady_climb(20);
  ASSERT_TRUE(predictor.add(fix_at(25, {0, 0, 75}, kSigma_m)));
  EXPECT_FALSE(predictor.at(gps_at(22)));
  EXPECT_TRUE(predictor.at(gps_at(25)));
  EXPECT_TRUE(predictor.at(gps_at(19)));
  // Nothing is known of the speed after one epoch.
  EXPECT_GT(predictor.at(gps_at(25.3))->covariance_enu_m2(2, 2), 1);
}

TEST(AntennaPredictor, ForgetsWhatIsOlderThanItsHistory) {
  const AntennaPredictor predictor = steady_climb(60);
  EXPECT_FALSE(predictor.at(gps_at(49)));
  EXPECT_TRUE(predictor.at(gps_at(51)));
}

}  // namespace
}  // namespace plumbline::timing
