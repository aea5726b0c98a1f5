// SPDX-License-Identifier: MIT
#include "edge/orient/adjust.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>

#include "edge/base/units.h"
#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient {
namespace {

using testing::FlightPlan;
using testing::MadeFlight;
using testing::make_flight;

// What many flights showed beside what they stated.
struct Coverage {
  int trials = 0, errors = 0, within_one = 0, within_two = 0, unconverged = 0;
  double nees = 0;
  double squares = 0, stated = 0;
  int rejected = 0;

  void add(const MadeFlight& flight, const Solution& solution) {
    ++trials;
    unconverged += solution.summary.converged ? 0 : 1;
    rejected += solution.summary.observations_rejected;
    std::vector<int> measured;
    std::vector<double> differences;
    for (std::size_t p = 0; p < solution.points.size(); ++p) {
      const MeasuredPoint& point = solution.points[p];
      if (!point.measured) continue;
      measured.push_back(static_cast<int>(p));
      const Eigen::Vector3d difference = point.in_enu_m - flight.points[p];
      for (int axis = 0; axis < 3; ++axis) {
        const double variance = point.covariance_m2(axis, axis);
        differences.push_back(difference[axis]);
        within_one += difference[axis] * difference[axis] < variance ? 1 : 0;
        within_two += difference[axis] * difference[axis] < 4 * variance ? 1 : 0;
        squares += difference[axis] * difference[axis];
        stated += variance;
        ++errors;
      }
    }
    const Eigen::Map<Eigen::VectorXd> d(differences.data(),
                                        static_cast<Eigen::Index>(differences.size()));
    nees += d.dot(solution.covariances->joint(measured).ldlt().solve(d));
  }
  double one() const { return static_cast<double>(within_one) / errors; }
  double two() const { return static_cast<double>(within_two) / errors; }
  double nees_ratio() const { return nees / errors; }
  double rms_over_stated() const { return std::sqrt(squares / stated); }
};

Coverage fly_many(const FlightPlan& plan, int trials) {
  Coverage coverage;
  for (int trial = 0; trial < trials; ++trial) {
    const MadeFlight flight = make_flight(plan, 5000 + static_cast<std::uint64_t>(trial));
    const auto solution = adjust(flight.problem, {});
    EXPECT_TRUE(solution.ok()) << solution.error().sentence;
    if (solution) coverage.add(flight, *solution);
  }
  return coverage;
}

// The errors of one flight are alike (six stations carry them all), so the shares of sixty flights
// scatter by about two per cent; NEES does not, since it takes the correlation off: chi-square with
// 60 * 117 degrees of freedom has a ratio of 1 +- 0.017.
TEST(Adjust, StatesErrorBarsThatCoverAClimbWithASideStep) {
  const Coverage coverage = fly_many({}, 60);
  EXPECT_EQ(coverage.unconverged, 0);
  EXPECT_NEAR(coverage.one(), 0.683, 0.06);
  EXPECT_NEAR(coverage.two(), 0.954, 0.03);
  EXPECT_NEAR(coverage.nees_ratio(), 1.0, 0.06);
  EXPECT_NEAR(coverage.rms_over_stated(), 1.0, 0.15);
}

TEST(Adjust, EstimatesTheSigmaOfPicksThatNobodyStated) {
  FlightPlan plan;
  plan.group = ImageGroup::kPicks;
  plan.targets = 150;
  const MadeFlight flight = make_flight(plan, 7);
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_NEAR(solution->summary.image_sigma_px, plan.image_sigma_px, 0.03);
  EXPECT_NEAR(solution->summary.sigma0_by_group.at("picks"), 1.0, 0.02);
}

TEST(Adjust, StaysWithinItsErrorBarsWithTenPercentMismatches) {
  FlightPlan plan;
  plan.gross_share = 0.1;
  const Coverage coverage = fly_many(plan, 40);
  EXPECT_NEAR(coverage.one(), 0.683, 0.08);
  EXPECT_NEAR(coverage.two(), 0.954, 0.04);
  EXPECT_LT(coverage.rms_over_stated(), 1.25);
  // 39 points in six photos, one observation in ten wrong; points that lose too many rays lose all.
  EXPECT_GT(coverage.rejected, 40 * 17);
}

TEST(Adjust, SaysThatAPureClimbDoesNotKnowItsAzimuth) {
  FlightPlan plan;
  plan.side_step_m = 0;
  plan.drift_m = 0.1;
  const MadeFlight flight = make_flight(plan, 11);
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_TRUE(testing::calls_unobservable(solution->summary, "azimuth"));
  EXPECT_GT(solution->summary.common.azimuth_rad, 5 * kRadPerDeg);
  // Absolute sigmas grow with the distance from the foot; those of the shape do not follow.
  const auto far = std::max_element(
      flight.points.begin(), flight.points.end(),
      [](const auto& a, const auto& b) { return a.head(2).norm() < b.head(2).norm(); });
  const auto& point = solution->points[static_cast<std::size_t>(far - flight.points.begin())];
  EXPECT_GT(point.covariance_m2.topLeftCorner(2, 2).trace(),
            25 * point.local_covariance_m2.topLeftCorner(2, 2).trace());
}

TEST(Adjust, KnowsTheAzimuthAfterASideStep) {
  const auto solution = adjust(make_flight({}, 12).problem, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_FALSE(testing::calls_unobservable(solution->summary, "azimuth"));
  EXPECT_LT(solution->summary.common.azimuth_rad, 1 * kRadPerDeg);
}

TEST(Adjust, TakesTheAzimuthOfAPureClimbFromAHeadingAndSaysSo) {
  FlightPlan plan;
  plan.side_step_m = 0;
  plan.drift_m = 0.05;
  plan.heading_sigma_deg = 2;
  const auto solution = adjust(make_flight(plan, 13).problem, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_LT(solution->summary.common.azimuth_rad, 2.3 * kRadPerDeg);
  EXPECT_TRUE(testing::calls_unobservable(solution->summary, "azimuth"));
}

FlightPlan two_photos_and_a_heading() {
  FlightPlan plan;
  plan.heights_m = {70, 90};
  plan.side_step_m = 0;
  plan.tilt_sigma_deg = 2;
  plan.heading_sigma_deg = 1;
  plan.image_sigma_px = 0.3;
  return plan;
}

// A point near the axis whose residuals bend the cost as much as its rays do: full steps along its
// height swing from one side of the minimum to the other: that took more than a thousand.
TEST(Adjust, ConvergesWhereFullStepsSwingToAndFro) {
  const auto solution = adjust(make_flight(two_photos_and_a_heading(), 100531).problem, {});
  ASSERT_TRUE(solution) << solution.error().sentence;
  EXPECT_TRUE(solution->summary.converged);
  EXPECT_LT(solution->summary.iterations, 1000);
}

// Where the level is known to degrees only, the foot of the climb may come to lie on a point, and
// the point on the way to its camera: there it fits all images, and 70 m off drags the level along.
TEST(Adjust, LeavesOutAPointThatIsLedToACamera) {
  const testing::MadeFlight flight = make_flight(two_photos_and_a_heading(), 101877);
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution) << solution.error().sentence;
  for (std::size_t p = 0; p < flight.points.size(); ++p) {
    const MeasuredPoint& point = solution->points[p];
    if (!point.measured) continue;
    const Eigen::Vector3d error = point.in_enu_m - flight.points[p];
    const Eigen::Vector3d sigma = point.covariance_m2.diagonal().cwiseSqrt();
    EXPECT_LT((error.array() / sigma.array()).abs().maxCoeff(), 4) << "point " << p;
  }
}

TEST(Adjust, NamesAStationThatIsOff) {
  // In plan a photo's tilt would take up as much; in height nothing does.
  FlightPlan plan;
  plan.targets = 300;
  plan.image_sigma_px = 0.1;
  MadeFlight flight = make_flight(plan, 14);
  flight.problem.photos[2].station->antenna_in_enu_m.z() += 0.3;
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_TRUE(solution->photos[2].station_rejected);
  EXPECT_NEAR(solution->photos[2].gnss_residual_m->z(), 0.3, 0.05);
  EXPECT_TRUE(std::any_of(solution->summary.warnings.begin(), solution->summary.warnings.end(),
                          [](const std::string& s) { return s.find("photo3") != s.npos; }));
}

TEST(Adjust, OrientsWithoutAnyPositionUpToScaleAndSaysSo) {
  FlightPlan plan;
  plan.stations = false;
  const MadeFlight flight = make_flight(plan, 15);
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_TRUE(testing::calls_unobservable(solution->summary, "scale"));
  EXPECT_TRUE(testing::calls_unobservable(solution->summary, "position"));
  EXPECT_TRUE(testing::calls_unobservable(solution->summary, "azimuth"));
  // The shape is right: ratios of distances agree with truth.
  const auto distance = [&](int a, int b) {
    return (solution->points[static_cast<std::size_t>(a)].in_enu_m -
            solution->points[static_cast<std::size_t>(b)].in_enu_m)
        .norm();
  };
  const double truth =
      (flight.points[0] - flight.points[1]).norm() / (flight.points[2] - flight.points[3]).norm();
  EXPECT_NEAR(distance(0, 1) / distance(2, 3) / truth, 1, 0.02);
}

TEST(Adjust, TakesScaleFromAKnownLengthAlone) {
  FlightPlan plan;
  plan.stations = false;
  MadeFlight flight = make_flight(plan, 16);
  const double metres = (flight.points[0] - flight.points[1]).norm();
  flight.problem.lengths.push_back({0, 1, metres, 0.002});
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_FALSE(testing::calls_unobservable(solution->summary, "scale"));
  const Eigen::Vector3d difference = solution->points[4].in_enu_m - solution->points[5].in_enu_m;
  const Eigen::MatrixXd joint = solution->covariances->joint({4, 5});
  const Eigen::Matrix3d covariance = joint.topLeftCorner(3, 3) + joint.bottomRightCorner(3, 3) -
                                     joint.topRightCorner(3, 3) - joint.bottomLeftCorner(3, 3);
  const Eigen::Vector3d along = difference.normalized();
  const double sigma = std::sqrt(along.dot(covariance * along));
  EXPECT_NEAR(difference.norm(), (flight.points[4] - flight.points[5]).norm(), 4 * sigma);
  EXPECT_LT(sigma, 0.5);
}

TEST(Adjust, GivesAControlPointsFrameWithoutStations) {
  FlightPlan plan;
  plan.stations = false;
  MadeFlight flight = make_flight(plan, 17);
  for (const int point : {3, 8, 21, 30}) {
    flight.problem.control.push_back({point, flight.points[static_cast<std::size_t>(point)],
                                      1e-4 * Eigen::Matrix3d::Identity()});
  }
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution.ok());
  EXPECT_FALSE(testing::calls_unobservable(solution->summary, "position"));
  EXPECT_FALSE(testing::calls_unobservable(solution->summary, "azimuth"));
  Coverage coverage;
  coverage.add(flight, *solution);
  EXPECT_LT(coverage.nees_ratio(), 1.5);
}

TEST(Adjust, AllowsForTheLeverArmOfTheAntenna) {
  MadeFlight flight = make_flight({}, 18);
  const Eigen::Vector3d arm(0.10, -0.05, 0.25);
  flight.problem.lever_arm.in_photo_m = arm;
  for (std::size_t i = 0; i < flight.poses.size(); ++i) {
    flight.problem.photos[i].station->antenna_in_enu_m += flight.poses[i].ground_from_photo * arm;
  }
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution.ok());
  Coverage coverage;
  coverage.add(flight, *solution);
  EXPECT_LT(coverage.nees_ratio(), 1.5);
}

TEST(Adjust, IsAPureFunctionOfItsInput) {
  const MadeFlight flight = make_flight({}, 19);
  const auto first = adjust(flight.problem, {}), second = adjust(flight.problem, {});
  ASSERT_TRUE(first.ok() && second.ok());
  for (std::size_t p = 0; p < first->points.size(); ++p) {
    EXPECT_EQ(first->points[p].in_enu_m, second->points[p].in_enu_m);
    EXPECT_EQ(first->points[p].covariance_m2, second->points[p].covariance_m2);
  }
}

TEST(Adjust, RefusesPhotosOfOnePlace) {
  FlightPlan plan;
  plan.heights_m = {80, 80, 80};
  plan.side_step_m = 0;
  plan.drift_m = 0;
  const auto solution = adjust(make_flight(plan, 20).problem, {});
  ASSERT_FALSE(solution.ok());
  EXPECT_NE(solution.error().sentence.find("same place"), std::string::npos);
}

TEST(Adjust, RefusesOnePhotoAndNumbersThatAreNone) {
  MadeFlight flight = make_flight({}, 21);
  Problem one = flight.problem;
  one.photos.resize(1);
  EXPECT_FALSE(adjust(one, {}).ok());
  Problem none = flight.problem;
  none.observations[5].pixel.x() = std::nan("");
  EXPECT_FALSE(adjust(none, {}).ok());
  Problem empty = flight.problem;
  empty.observations.clear();
  EXPECT_FALSE(adjust(empty, {}).ok());
}

}  // namespace
}  // namespace plumbline::orient
