// SPDX-License-Identifier: MIT
#include "edge/orient/three_point_frame.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "edge/geometry/rotation.h"
#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient {
namespace {

using testing::FlightPlan;
using testing::MadeFlight;
using testing::make_flight;

// Any covariance of photos and points together: photo k in columns 6k, point p after all photos.
class Dense final : public PointCovariances {
 public:
  Dense(Eigen::MatrixXd all, int photos) : all_(std::move(all)), first_(6 * photos) {}
  Eigen::MatrixXd joint(const std::vector<int>& points) const override {
    const auto columns = columns_of(points);
    return all_(columns, columns);
  }
  Eigen::MatrixXd with_photo(int photo, const std::vector<int>& points) const override {
    return all_(Eigen::seqN(6 * photo, 6), columns_of(points));
  }

 private:
  std::vector<int> columns_of(const std::vector<int>& points) const {
    std::vector<int> columns;
    for (const int p : points)
      for (int i = 0; i < 3; ++i) columns.push_back(first_ + 3 * p + i);
    return columns;
  }
  Eigen::MatrixXd all_;
  int first_;
};

struct World {
  Problem problem;
  Solution solution;
  FrameRoles roles{0, 1, 2};
};

World world(const std::vector<Eigen::Vector3d>& points, const geometry::Pose& pose,
            const Eigen::MatrixXd& covariance) {
  World w;
  for (std::size_t p = 0; p < points.size(); ++p) {
    w.problem.point_names.push_back("P" + std::to_string(p));
    MeasuredPoint point;
    point.measured = true;
    point.in_enu_m = points[p];
    w.solution.points.push_back(point);
  }
  OrientedPhoto photo;
  photo.oriented = true;
  photo.pose = pose;
  photo.covariance = covariance.topLeftCorner<6, 6>();
  w.problem.photos.emplace_back();
  w.solution.photos.push_back(photo);
  w.solution.covariances = std::make_shared<Dense>(covariance, 1);
  return w;
}

const std::vector<Eigen::Vector3d> kPlaces = {
    {10, 20, 5}, {10, 24, 8}, {7, 20, 5}, {7, 24, 8}, {16, 20, 7}};
const geometry::Pose kPose = {{10, 20, 85}, geometry::ground_from_photo({0.02, -0.03, 0.7})};

// Origin (10, 20, 5); the x axis runs (0, 4, 3), 5 m long; the third point lies 3 m to its west. So
// X = (0, .8, .6), Y = (-1, 0, 0), Z = X x Y = (0, -.6, .8), worked by hand.
TEST(ThreePointFrame, GivesTheCoordinatesOfACaseWorkedByHand) {
  const World w = world(kPlaces, kPose, Eigen::MatrixXd::Identity(21, 21));
  const auto local = in_three_point_frame(w.problem, w.solution, w.roles, {});
  ASSERT_TRUE(local.ok()) << local.error().sentence;
  const auto place = [&](std::size_t p) { return local->points[p].in_enu_m; };
  EXPECT_EQ(place(0), Eigen::Vector3d(0, 0, 0));
  EXPECT_LT((place(1) - Eigen::Vector3d(5, 0, 0)).norm(), 1e-12);
  EXPECT_LT((place(2) - Eigen::Vector3d(0, 3, 0)).norm(), 1e-12);
  EXPECT_LT((place(3) - Eigen::Vector3d(5, 3, 0)).norm(), 1e-12);
  // (6, 0, 2): X 1.2, Y -6, Z 1.6.
  EXPECT_LT((place(4) - Eigen::Vector3d(1.2, -6, 1.6)).norm(), 1e-12);
  EXPECT_LT((local->photos[0].pose.centre_m - Eigen::Vector3d(48, 0, 64)).norm(), 1e-12);
  ASSERT_TRUE(local->frame.has_value());
}

TEST(ThreePointFrame, PointsItsZToThePhotosWhicheverSideTheThirdPointIs) {
  auto places = kPlaces;
  places[2] = {13, 20, 5};
  const World w = world(places, kPose, Eigen::MatrixXd::Identity(21, 21));
  const auto local = in_three_point_frame(w.problem, w.solution, w.roles, {});
  ASSERT_TRUE(local.ok());
  EXPECT_GT(local->photos[0].pose.centre_m.z(), 0);
  EXPECT_LT((local->points[2].in_enu_m - Eigen::Vector3d(0, -3, 0)).norm(), 1e-12);
}

// Only the x axis point errs, by (a, b, c) along X, Y, Z: a point at (x, y, 0) turns by -b / 5
// about Z and by c / 5 about Y, so that its own covariance is, by hand,
//   Y: x^2 b^2 / 25, X: y^2 b^2 / 25, and Z: (x - x_plane y / y_plane)^2 c^2 / 25.
TEST(ThreePointFrame, CarriesTheErrorOfTheAxisPointIntoTheOthers) {
  Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(21, 21);
  covariance.block<3, 3>(9, 9) = 0.01 * Eigen::Matrix3d::Identity();
  const World w = world(kPlaces, kPose, covariance);
  const auto local = in_three_point_frame(w.problem, w.solution, w.roles, {});
  ASSERT_TRUE(local.ok());
  const Eigen::Matrix3d& axis = local->points[1].covariance_m2;
  EXPECT_NEAR(axis(0, 0), 0.01, 1e-12);
  EXPECT_EQ(axis(1, 1), 0);
  EXPECT_EQ(axis(2, 2), 0);
  EXPECT_TRUE(local->points[0].covariance_m2.isZero(0));
  const Eigen::Matrix3d& corner = local->points[3].covariance_m2;  // (5, 3, 0)
  EXPECT_NEAR(corner(0, 0), 9 * 0.01 / 25, 1e-12);
  EXPECT_NEAR(corner(1, 1), 25 * 0.01 / 25, 1e-12);
  EXPECT_NEAR(corner(2, 2), 25 * 0.01 / 25, 1e-12);
  EXPECT_EQ(local->points[2].covariance_m2(2, 2), 0);
}

// Moves everything at random, measures again in the frame that moved with it, and compares the
// spread with what is stated: points, photo, and both together.
TEST(ThreePointFrame, StatesTheSpreadThatManyRandomMovesShow) {
  std::mt19937_64 random(41);
  std::normal_distribution<double> normal;
  Eigen::MatrixXd mix(21, 21);
  for (Eigen::Index i = 0; i < mix.size(); ++i) mix.data()[i] = 2e-4 * normal(random);
  const World w = world(kPlaces, kPose, mix * mix.transpose());
  const auto stated = in_three_point_frame(w.problem, w.solution, w.roles, {});
  ASSERT_TRUE(stated.ok());
  constexpr int kTrials = 4000;
  Eigen::MatrixXd spread = Eigen::MatrixXd::Zero(21, 21);
  for (int trial = 0; trial < kTrials; ++trial) {
    Eigen::VectorXd move(21);
    for (double& value : move) value = normal(random);
    move = mix * move;
    World moved = w;
    geometry::Pose& pose = moved.solution.photos[0].pose;
    pose.centre_m += move.head<3>();
    pose.ground_from_photo = geometry::rotation_by(move.segment<3>(3)) * pose.ground_from_photo;
    for (std::size_t p = 0; p < kPlaces.size(); ++p)
      moved.solution.points[p].in_enu_m += move.segment<3>(6 + 3 * static_cast<Eigen::Index>(p));
    const auto local = in_three_point_frame(moved.problem, moved.solution, w.roles, {});
    ASSERT_TRUE(local.ok());
    Eigen::VectorXd change(21);
    change.head<3>() = local->photos[0].pose.centre_m - stated->photos[0].pose.centre_m;
    const Eigen::AngleAxisd turn(
        Eigen::Matrix3d(local->photos[0].pose.ground_from_photo *
                        stated->photos[0].pose.ground_from_photo.transpose()));
    change.segment<3>(3) = turn.angle() * turn.axis();
    for (std::size_t p = 0; p < kPlaces.size(); ++p)
      change.segment<3>(6 + 3 * static_cast<Eigen::Index>(p)) =
          local->points[p].in_enu_m - stated->points[p].in_enu_m;
    spread += change * change.transpose() / kTrials;
  }
  Eigen::MatrixXd expected(21, 21);
  const std::vector<int> all = {0, 1, 2, 3, 4};
  expected.topLeftCorner<6, 6>() = stated->photos[0].covariance;
  expected.bottomRightCorner(15, 15) = stated->covariances->joint(all);
  expected.topRightCorner(6, 15) = stated->covariances->with_photo(0, all);
  expected.bottomLeftCorner(15, 6) = expected.topRightCorner(6, 15).transpose();
  // A sample covariance of n trials scatters by sqrt((1 + rho^2) / n) of its scale: 5 sigma.
  const Eigen::VectorXd sigma = expected.diagonal().cwiseSqrt();
  for (int i = 0; i < 21; ++i) {
    for (int j = 0; j < 21; ++j) {
      EXPECT_NEAR(spread(i, j), expected(i, j),
                  5 * std::sqrt(2.0 / kTrials) * sigma[i] * sigma[j] + 1e-12)
          << i << "," << j;
    }
  }
}

// The corners of the field, as a user would choose them: near one another, or on a line, three
// points turn the whole by more than first-order error bars can follow.
FrameRoles far_apart(const std::vector<Eigen::Vector3d>& points) {
  const auto furthest = [&](double east, double north) {
    int best = 0;
    for (int p = 1; p < static_cast<int>(points.size()); ++p) {
      const Eigen::Vector3d along =
          points[static_cast<std::size_t>(p)] - points[static_cast<std::size_t>(best)];
      if (east * along.x() + north * along.y() > 0) best = p;
    }
    return best;
  };
  return {furthest(-1, -1), furthest(1, -1), furthest(0, 1)};
}

TEST(ThreePointFrame, CoversTheErrorsOfManyFlightsInTheFrame) {
  int coordinates = 0, within_one = 0, within_two = 0;
  double nees = 0;
  for (std::uint64_t seed = 300; seed < 330; ++seed) {
    FlightPlan plan;
    plan.side_step_m = 10;
    MadeFlight flight = make_flight(plan, seed);
    const auto solution = adjust(flight.problem, {});
    ASSERT_TRUE(solution.ok());
    const FrameRoles roles = far_apart(flight.points);
    const auto true_place = [&](int p) { return flight.points[static_cast<std::size_t>(p)]; };
    const auto frame = three_point_frame(true_place(roles.origin), true_place(roles.x_axis),
                                         true_place(roles.plane), flight.poses[0].centre_m);
    const auto local = in_three_point_frame(flight.problem, *solution, roles, {});
    ASSERT_TRUE(frame && local.ok());
    std::vector<int> measured;
    Eigen::VectorXd d(3 * static_cast<Eigen::Index>(local->points.size()));
    Eigen::Index size = 0;
    for (std::size_t p = 0; p < local->points.size(); ++p) {
      const auto point = static_cast<int>(p);
      const bool of_frame = point == roles.origin || point == roles.x_axis || point == roles.plane;
      if (!local->points[p].measured || of_frame) continue;
      measured.push_back(static_cast<int>(p));
      d.segment<3>(size) = local->points[p].in_enu_m - (*frame)(flight.points[p]);
      for (int axis = 0; axis < 3; ++axis) {
        const double ratio =
            std::pow(d[size + axis], 2) / local->points[p].covariance_m2(axis, axis);
        within_one += ratio < 1 ? 1 : 0;
        within_two += ratio < 4 ? 1 : 0;
      }
      size += 3;
    }
    const Eigen::VectorXd used = d.head(size);
    nees += used.dot(local->covariances->joint(measured).ldlt().solve(used));
    coordinates += static_cast<int>(size);
  }
  ASSERT_GT(coordinates, 2500);
  // chi-square with about 3200 degrees of freedom: ratio 1 +- 0.025; errors of one flight are alike
  // (six coordinates of the frame carry them), so that the shares scatter by about three per cent.
  EXPECT_NEAR(nees / coordinates, 1.0, 0.1);
  EXPECT_NEAR(static_cast<double>(within_one) / coordinates, 0.683, 0.09);
  EXPECT_NEAR(static_cast<double>(within_two) / coordinates, 0.954, 0.045);
}

TEST(ThreePointFrame, NoLongerCallsTheAzimuthUnobservable) {
  FlightPlan plan;
  plan.stations = false;
  const MadeFlight flight = make_flight(plan, 45);
  const auto solution = adjust(flight.problem, {});
  ASSERT_TRUE(solution.ok());
  const auto local = in_three_point_frame(flight.problem, *solution, {0, 1, 2}, {});
  ASSERT_TRUE(local.ok());
  for (const Unobservable& u : local->summary.unobservable) {
    EXPECT_NE(u.name, "position");
    EXPECT_NE(u.name, "azimuth");
  }
  EXPECT_TRUE(std::isfinite(local->summary.common.position_m));
}

TEST(ThreePointFrame, RefusesThreePointsOfOneLineAndPointsNotMeasured) {
  auto places = kPlaces;
  places[2] = {10, 32.01, 14};
  World w = world(places, kPose, Eigen::MatrixXd::Identity(21, 21));
  const auto line = in_three_point_frame(w.problem, w.solution, w.roles, {});
  ASSERT_FALSE(line.ok());
  EXPECT_NE(line.error().sentence.find("P0, P1, P2"), std::string::npos);
  w = world(kPlaces, kPose, Eigen::MatrixXd::Identity(21, 21));
  w.solution.points[1].measured = false;
  const auto missing = in_three_point_frame(w.problem, w.solution, w.roles, {});
  ASSERT_FALSE(missing.ok());
  EXPECT_NE(missing.error().sentence.find("P1"), std::string::npos);
}

}  // namespace
}  // namespace plumbline::orient
