// SPDX-License-Identifier: MIT
#include "edge/gnss/antenna_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <iostream>
#include <random>

namespace plumbline::gnss {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

const UtcTime kStart = std::chrono::sys_days(std::chrono::year(2026) / 11 / 20);
const geodesy::Geodetic kFoot{35.668724278, 139.762757202, 90.263};

using Path = std::function<Eigen::Vector3d(double t_s)>;

// A climb at 2 m/s that sways and pauses: up to 1 m/s2.
Eigen::Vector3d climb(double t_s) {
  return {0.6 * std::sin(1.1 * t_s), 0.5 * std::cos(0.9 * t_s), 2.0 * t_s + 0.8 * std::sin(t_s)};
}

UtcTime at_s(double t_s) { return kStart + microseconds(std::llround(t_s * 1e6)); }

GnssFix fix_at(const geodesy::LocalFrame& frame, double t_s, const Eigen::Vector3d& enu_m,
               const std::optional<Eigen::Matrix3d>& covariance,
               FixQuality quality = FixQuality::kFixed) {
  const geodesy::Geodetic place = frame.geodetic_of(enu_m);
  GnssFix fix;
  fix.time = at_s(t_s);
  fix.quality = quality;
  fix.latitude_deg = place.latitude_deg;
  fix.longitude_deg = place.longitude_deg;
  fix.height_ellipsoidal_m = place.height_ellipsoidal_m;
  fix.covariance_enu_m2 = covariance;
  return fix;
}

geodesy::LocalFrame foot() { return *geodesy::LocalFrame::at(kFoot); }

std::vector<GnssFix> log_of(const Path& path, double rate_hz, double length_s) {
  std::vector<GnssFix> fixes;
  const Eigen::Matrix3d tiny = Eigen::Matrix3d::Identity() * 1e-12;
  for (int i = 0; i <= static_cast<int>(length_s * rate_hz); ++i) {
    fixes.push_back(fix_at(foot(), i / rate_hz, path(i / rate_hz), tiny));
  }
  return fixes;
}

TEST(AntennaTrack, GivesBackTheEpochsThemselves) {
  const auto fixes = log_of(climb, 5, 10);
  const auto track = AntennaTrack::from(fixes);
  for (const GnssFix& fix : fixes) {
    const auto state = track.at(*fix.time);
    ASSERT_TRUE(state);
    EXPECT_NEAR(state->position.latitude_deg, *fix.latitude_deg, 1e-12);
    EXPECT_NEAR(state->position.longitude_deg, *fix.longitude_deg, 1e-12);
    EXPECT_NEAR(state->position.height_ellipsoidal_m, *fix.height_ellipsoidal_m, 1e-6);
  }
}

TEST(AntennaTrack, FollowsACubicExactlyAndItsVelocity) {
  const Path cubic = [](double t) {
    return Eigen::Vector3d(0.3 * t * t * t - t, 2 * t * t, 2 * t + 0.1 * t * t * t);
  };
  const auto track = AntennaTrack::from(log_of(cubic, 1, 10));
  for (const double t : {1.25, 4.5, 7.9}) {
    const auto state = track.at(at_s(t));
    ASSERT_TRUE(state);
    EXPECT_LT((foot().enu_of(state->position) - cubic(t)).norm(), 1e-6);
    const Eigen::Vector3d velocity(0.9 * t * t - 1, 4 * t, 2 + 0.3 * t * t);
    EXPECT_LT((state->velocity_enu_m_s - velocity).norm(), 1e-3);  // frames differ by 1e-5 rad
  }
}

// Shares of errors within one and two stated sigma, over all axes.
struct Coverage {
  int count = 0;
  int one = 0;
  int two = 0;
  void add(const Eigen::Vector3d& error_m, const Eigen::Matrix3d& covariance_m2) {
    for (int axis = 0; axis < 3; ++axis) {
      const double ratio = std::abs(error_m[axis]) / std::sqrt(covariance_m2(axis, axis));
      ++count;
      one += ratio <= 1;
      two += ratio <= 2;
    }
  }
  double share_one() const { return static_cast<double>(one) / count; }
  double share_two() const { return static_cast<double>(two) / count; }
};

// One flight with Gauss-Markov noise of 30 s and the given sigma, sampled at random times.
void fly(std::uint64_t seed, double rate_hz, const Eigen::Vector3d& sigma_m, Coverage& coverage) {
  std::mt19937_64 random(seed);
  std::normal_distribution<double> normal;
  const Eigen::Matrix3d covariance = sigma_m.cwiseAbs2().asDiagonal();
  const double keep = std::exp(-1 / (30 * rate_hz));
  Eigen::Vector3d noise = sigma_m.cwiseProduct(
      Eigen::Vector3d::NullaryExpr([&](Eigen::Index) { return normal(random); }));
  std::vector<GnssFix> fixes;
  for (int i = 0; i <= static_cast<int>(40 * rate_hz); ++i) {
    fixes.push_back(fix_at(foot(), i / rate_hz, climb(i / rate_hz) + noise, covariance));
    for (int axis = 0; axis < 3; ++axis) {
      noise[axis] =
          keep * noise[axis] + std::sqrt(1 - keep * keep) * sigma_m[axis] * normal(random);
    }
  }
  const auto track = AntennaTrack::from(fixes);
  std::uniform_real_distribution<double> when(0.5, 39.5);
  for (int i = 0; i < 5; ++i) {
    const double t = when(random);
    const auto state = track.at(at_s(t));
    ASSERT_TRUE(state);
    coverage.add(foot().enu_of(state->position) - climb(std::round(t * 1e6) / 1e6),
                 state->covariance_enu_m2);
  }
}

TEST(AntennaTrack, StatesSigmasThatHoldForFiveHertzRtk) {
  Coverage coverage;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) fly(seed, 5, {0.005, 0.005, 0.01}, coverage);
  std::cout << "within one sigma " << coverage.share_one() << ", two " << coverage.share_two()
            << " of " << coverage.count << "\n";
  EXPECT_GT(coverage.share_one(), 0.60);
  EXPECT_LT(coverage.share_one(), 0.80);
  EXPECT_GT(coverage.share_two(), 0.92);
}

TEST(AntennaTrack, StatesSigmasThatAreNotTooSmallForOneHertzRtk) {
  Coverage coverage;
  for (std::uint64_t seed = 1; seed <= 300; ++seed) fly(seed, 1, {0.005, 0.005, 0.01}, coverage);
  std::cout << "within one sigma " << coverage.share_one() << ", two " << coverage.share_two()
            << " of " << coverage.count << "\n";
  EXPECT_GT(coverage.share_one(), 0.60);
  EXPECT_GT(coverage.share_two(), 0.92);
}

TEST(AntennaTrack, GivesNoPositionOutsideTheLogOrInAGap) {
  auto fixes = log_of(climb, 5, 20);
  fixes.erase(fixes.begin() + 25, fixes.begin() + 40);  // from 4.8 s to 8.0 s nothing is left
  const auto track = AntennaTrack::from(fixes);
  EXPECT_FALSE(track.at(at_s(-0.001)));
  EXPECT_FALSE(track.at(at_s(20.001)));
  EXPECT_FALSE(track.at(at_s(6.0)));
  EXPECT_TRUE(track.at(at_s(4.8)));
  EXPECT_TRUE(track.at(at_s(8.0)));
  EXPECT_TRUE(track.at(at_s(0)));
  EXPECT_TRUE(track.at(at_s(20)));
}

TEST(AntennaTrack, BridgesAGapOfTwoSeconds) {
  auto fixes = log_of(climb, 1, 10);
  fixes.erase(fixes.begin() + 5);
  EXPECT_TRUE(AntennaTrack::from(fixes).at(at_s(5.0)));
}

TEST(AntennaTrack, TakesTheWorseQualityOfTheTwoEpochsAround) {
  auto fixes = log_of(climb, 5, 2);
  fixes[5].quality = FixQuality::kFloat;
  fixes[5].covariance_enu_m2 = std::nullopt;
  const auto track = AntennaTrack::from(fixes);
  EXPECT_EQ(track.at(at_s(0.9))->quality, FixQuality::kFloat);
  EXPECT_TRUE(track.at(at_s(0.9))->sigma_assumed);
  EXPECT_EQ(track.at(at_s(0.7))->quality, FixQuality::kFixed);
  EXPECT_EQ(track.at(at_s(1.0))->quality, FixQuality::kFloat);
  EXPECT_EQ(track.at(at_s(0.8))->quality, FixQuality::kFixed);
  EXPECT_NEAR(std::sqrt(track.at(at_s(1.0))->covariance_enu_m2(0, 0)), 0.3, 1e-6);
}

TEST(AntennaTrack, LeavesOutWhatIsNotMeasuredFromSatellites) {
  auto fixes = log_of(climb, 5, 2);
  for (auto& fix : fixes) fix.quality = FixQuality::kEstimated;
  EXPECT_TRUE(AntennaTrack::from(fixes).empty());
}

TEST(AntennaTrack, SortsALogThatRunsBackwardsAndDropsEqualTimes) {
  auto fixes = log_of(climb, 5, 2);
  std::reverse(fixes.begin(), fixes.end());
  fixes.push_back(fixes.back());
  const auto track = AntennaTrack::from(fixes);
  EXPECT_EQ(track.epochs().size(), 11u);
  EXPECT_TRUE(track.at(at_s(1.1)));
}

TEST(AntennaTrack, KnowsNothingFromOneEpoch) {
  const auto track = AntennaTrack::from(log_of(climb, 1, 0));
  EXPECT_FALSE(track.at(kStart));
  EXPECT_TRUE(AntennaTrack::from({}).empty());
}

}  // namespace
}  // namespace plumbline::gnss
