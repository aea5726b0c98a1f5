// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>
#include <random>

#include "edge/base/index.h"
#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/start/align.h"
#include "edge/orient/start/azimuth_search.h"
#include "edge/orient/start/free_start.h"
#include "edge/orient/start/plane_similarity.h"
#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient {
namespace {

using testing::FlightPlan;
using testing::MadeFlight;
using testing::make_flight;

std::vector<PlaneMatch> matches_with_mismatches(std::complex<double> a, std::complex<double> b,
                                                double share, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::uniform_real_distribution<double> place(-1, 1);
  std::normal_distribution<double> noise(0, 0.005);
  std::vector<PlaneMatch> matches;
  for (int i = 0; i < 80; ++i) {
    const PlanePoint first(place(random), place(random));
    PlanePoint second = a * first + b + PlanePoint(noise(random), noise(random));
    if (i < share * 80) second = {place(random), place(random)};
    matches.push_back({first, second});
  }
  return matches;
}

TEST(PlaneSimilarity, IsFoundAmongHalfMismatches) {
  for (std::uint64_t seed = 1; seed <= 50; ++seed) {
    const std::complex<double> a = std::polar(0.6 + 0.01 * static_cast<double>(seed),
                                              0.3 * static_cast<double>(seed)),
                               b(0.1, -0.2);
    const auto fit = fit_similarity(matches_with_mismatches(a, b, 0.5, seed), 0.03);
    ASSERT_TRUE(fit);
    EXPECT_LT(std::abs(fit->a - a), 0.02) << seed;
    EXPECT_LT(std::abs(fit->b - b), 0.02) << seed;
    EXPECT_GE(fit->inliers, 38);
  }
}

TEST(PlaneSimilarity, IsExactForExactMatches) {
  const std::complex<double> a(0.3, -0.9), b(0.5, 0.25);
  std::vector<PlaneMatch> matches;
  for (const PlanePoint z : {PlanePoint(0, 0), PlanePoint(1, 0), PlanePoint(0, 1),
                             PlanePoint(-1, 0.5), PlanePoint(0.3, -1)}) {
    matches.push_back({z, a * z + b});
  }
  const auto fit = fit_similarity(matches, 0.01);
  ASSERT_TRUE(fit);
  EXPECT_LT(std::abs(fit->a - a) + std::abs(fit->b - b), 1e-12);
  EXPECT_EQ(fit->inliers, 5);
}

TEST(PlaneSimilarity, IsAbsentWithTooFewOrCoincidentMatches) {
  const std::vector<PlaneMatch> three(3, PlaneMatch{{0.5, 0.5}, {0.1, 0.1}});
  EXPECT_FALSE(fit_similarity(three, 0.01));
  const std::vector<PlaneMatch> same(10, PlaneMatch{{0.5, 0.5}, {0.1, 0.1}});
  EXPECT_FALSE(fit_similarity(same, 0.01));
  EXPECT_FALSE(fit_similarity({}, 0.01));
}

FlightPlan level_plan() {
  FlightPlan plan;
  plan.tilt_sigma_deg = 0.5;
  plan.relief_m = 0.5;
  return plan;
}

// Mismatches within the tolerance (200 px) stay in: about 55 px rms on 30 points that reach 600 px
// out, so 2 % or 1 degree a pair, and a chain of pairs; five times that is allowed.
TEST(FreeStart, RecoversHeightRatiosAndTurnsOfAClimb) {
  FlightPlan plan = level_plan();
  plan.gross_share = 0.2;
  for (const std::uint64_t seed : {31U, 32U, 33U, 34U}) {
    const MadeFlight flight = make_flight(plan, seed);
    const auto start = free_start(flight.problem);
    ASSERT_TRUE(start);
    ASSERT_EQ(start->photo_of_slot.size(), flight.poses.size());
    const auto kappa = [](const geometry::Pose& pose) {
      return geometry::angles_of(pose.ground_from_photo).kappa_rad;
    };
    for (std::size_t i = 1; i < flight.poses.size(); ++i) {
      const geometry::Pose &found = start->state.poses[i], &first = start->state.poses[0];
      EXPECT_NEAR(found.centre_m.z() / first.centre_m.z(),
                  flight.poses[i].centre_m.z() / flight.poses[0].centre_m.z(), 0.1);
      const double turn =
          kappa(found) - kappa(first) - kappa(flight.poses[i]) + kappa(flight.poses[0]);
      EXPECT_LT(std::abs(std::remainder(turn, 2 * std::numbers::pi)), 5 * kRadPerDeg);
    }
  }
}

TEST(FreeStart, LeavesOutAPhotoOfOtherGround) {
  MadeFlight flight = make_flight(level_plan(), 35);
  for (Observation& o : flight.problem.observations) {
    if (o.photo != 2) continue;
    o.point += static_cast<int>(flight.points.size());
  }
  flight.problem.point_names.resize(2 * flight.points.size(), "other");
  const auto start = free_start(flight.problem);
  ASSERT_TRUE(start);
  EXPECT_EQ(start->photo_of_slot, (std::vector<int>{0, 1, 3, 4, 5}));
}

TEST(FreeStart, SaysSoWhereNoTwoPhotosHangTogether) {
  MadeFlight flight = make_flight(level_plan(), 36);
  std::erase_if(flight.problem.observations, [](const Observation& o) { return o.photo > 0; });
  const auto start = free_start(flight.problem);
  ASSERT_FALSE(start);
  EXPECT_NE(start.error().sentence.find("No two photos"), std::string::npos);
}

// The truth, shrunk, turned about the vertical and moved away, is brought back.
struct Displaced {
  Displaced(std::uint64_t seed, double turn_rad, const FlightPlan& plan = {})
      : flight(make_flight(plan, seed)) {
    std::vector<int> photos(flight.poses.size());
    std::iota(photos.begin(), photos.end(), 0);
    network = make_network(flight.problem, photos);
    free = {flight.interior, flight.poses, flight.points};
    const Eigen::Matrix3d turn = geometry::rotation_by({0, 0, turn_rad});
    const auto away = [&](const Eigen::Vector3d& x) {
      return Eigen::Vector3d(0.4 * turn * x + Eigen::Vector3d(300, -20, 7));
    };
    for (geometry::Pose& pose : free.poses) {
      pose.centre_m = away(pose.centre_m);
      pose.ground_from_photo = turn * pose.ground_from_photo;
    }
    for (Eigen::Vector3d& point : free.points) point = away(point);
    options.tilt_sigma_rad = 2 * kRadPerDeg;
    options.station_weights.assign(photos.size(), 1.0);
  }

  double worst_point_m(const State& state) const {
    double worst = 0;
    for (std::size_t p = 0; p < flight.points.size(); ++p) {
      worst = std::max(worst, (state.points[p] - flight.points[p]).norm());
    }
    return worst;
  }

  double worst_target_m(const State& state) const {
    double worst = 0;
    for (std::size_t p = 0; p < at(flight.targets); ++p)
      worst = std::max(worst, (state.points[p] - flight.points[p]).norm());
    return worst;
  }

  MadeFlight flight;
  Network network;
  State free;
  TermOptions options;
};

// Azimuth is tried every 5 degrees, so the far end of the field may be off by 2.5 degrees of 34 m.
TEST(Aligned, BringsAMovedNetworkBack) {
  for (const double turn : {0.0, 1.0, 3.1, -2.0}) {
    const Displaced moved(41, turn);
    EXPECT_LT(moved.worst_point_m(aligned(moved.network, moved.free, moved.options)), 3.5) << turn;
  }
}

TEST(Aligned, IsNotLedAwayByOneWrongStation) {
  for (const double turn : {0.5, 2.5, -1.2}) {
    Displaced moved(42, turn);
    moved.flight.problem.photos[2].station->antenna_in_enu_m += Eigen::Vector3d(6, -9, 15);
    EXPECT_LT(moved.worst_point_m(aligned(moved.network, moved.free, moved.options)), 5) << turn;
  }
}

// The photo beside the climb lies on its other side, and all look 11 degrees aside, each another
// way: only from another start does the descent come down to what images of 0.3 px cost.
TEST(DescentAroundCircle, ComesToItsSideHoweverManyTies) {
  for (const int ties : {0, 600}) {
    FlightPlan plan;
    plan.ties = ties;
    Displaced moved(43, 1.0, plan);
    Eigen::Vector3d& aside_m = moved.free.poses.back().centre_m;
    const Eigen::Vector3d axis_m = moved.free.poses.front().centre_m;
    aside_m.head<2>() = 2 * axis_m.head<2>() - aside_m.head<2>();
    double towards_rad = 0;
    for (geometry::Pose& pose : moved.free.poses) {
      towards_rad += 2;
      const Eigen::Vector3d tilt_rad(0.2 * std::cos(towards_rad), 0.2 * std::sin(towards_rad), 0);
      pose.ground_from_photo = geometry::rotation_by(tilt_rad) * pose.ground_from_photo;
    }
    const Descent descent =
        descend_around_circle(moved.network, moved.free, moved.options, {6, 200, 1e-6});
    const double rays = static_cast<double>(moved.network.rays.size());
    EXPECT_LT(descent.end.cost, 2 * rays) << ties;
    EXPECT_LT(moved.worst_target_m(descent.end.state), 1) << ties;
  }
}

}  // namespace
}  // namespace plumbline::orient
