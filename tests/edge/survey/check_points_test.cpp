// SPDX-License-Identifier: MIT
#include "edge/survey/check_points.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cmath>
#include <random>

namespace plumbline::survey {
namespace {

class KnownCovariances : public orient::PointCovariances {
 public:
  explicit KnownCovariances(Eigen::MatrixXd all) : all_(std::move(all)) {}
  Eigen::MatrixXd joint(const std::vector<int>& points) const override {
    const auto n = static_cast<Eigen::Index>(points.size());
    Eigen::MatrixXd c(3 * n, 3 * n);
    for (Eigen::Index i = 0; i < n; ++i)
      for (Eigen::Index j = 0; j < n; ++j)
        c.block<3, 3>(3 * i, 3 * j) = all_.block<3, 3>(3 * points[static_cast<std::size_t>(i)],
                                                       3 * points[static_cast<std::size_t>(j)]);
    return c;
  }
  Eigen::MatrixXd with_photo(int /*photo*/, const std::vector<int>& points) const override {
    return Eigen::MatrixXd::Zero(6, static_cast<Eigen::Index>(3 * points.size()));
  }

 private:
  Eigen::MatrixXd all_;
};

// A field of points, all measured, with the errors handed in.
struct Case {
  orient::Problem problem;
  orient::Solution solution;
  std::vector<CheckPoint> known;
};

Case field(int count, std::mt19937_64& random) {
  std::uniform_real_distribution<double> east(-30.0, 30.0);
  std::uniform_real_distribution<double> up(-2.0, 2.0);
  Case made;
  for (int i = 0; i < count; ++i) {
    const Eigen::Vector3d place(east(random), east(random), up(random));
    made.problem.point_names.push_back("P" + std::to_string(i));
    orient::MeasuredPoint measured;
    measured.measured = true;
    measured.in_enu_m = place;
    made.solution.points.push_back(measured);
    made.known.push_back({made.problem.point_names.back(), place, Eigen::Vector3d::Zero()});
  }
  orient::Photo photo;
  photo.station = orient::Station{};
  made.problem.photos.push_back(photo);
  return made;
}

// An offset and a turn common to all points, and noise of each.
Eigen::MatrixXd correlated_covariance(const Case& made, double noise_m) {
  const auto n = static_cast<Eigen::Index>(made.known.size());
  Eigen::MatrixXd by_common(3 * n, 4);
  for (Eigen::Index i = 0; i < n; ++i) {
    const Eigen::Vector3d& at = made.known[static_cast<std::size_t>(i)].in_enu_m;
    by_common.block<3, 3>(3 * i, 0) = 0.05 * Eigen::Matrix3d::Identity();
    by_common.block<3, 1>(3 * i, 3) = 0.002 * Eigen::Vector3d(-at.y(), at.x(), 0.0);
  }
  return by_common * by_common.transpose() +
         noise_m * noise_m * Eigen::MatrixXd::Identity(3 * n, 3 * n);
}

Eigen::VectorXd standard_normals(Eigen::Index count, std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  Eigen::VectorXd z(count);
  for (double& value : z) value = normal(random);
  return z;
}

// One draw of errors of the measured points, and of the known ones.
Case drawn(int count, double check_sigma_m, std::mt19937_64& random) {
  Case made = field(count, random);
  const Eigen::MatrixXd c = correlated_covariance(made, 0.01);
  const Eigen::MatrixXd factor = c.llt().matrixL();
  const Eigen::VectorXd errors = factor * standard_normals(3 * count, random);
  const Eigen::VectorXd known_errors = check_sigma_m * standard_normals(3 * count, random);
  for (std::size_t i = 0; i < made.known.size(); ++i) {
    const auto at = static_cast<Eigen::Index>(3 * i);
    made.solution.points[i].in_enu_m += errors.segment<3>(at);
    made.solution.points[i].covariance_m2 = c.block<3, 3>(at, at);
    made.known[i].in_enu_m += known_errors.segment<3>(at);
    made.known[i].sigma_m.setConstant(check_sigma_m);
  }
  made.solution.covariances = std::make_shared<KnownCovariances>(c);
  return made;
}

TEST(CheckPoints, RightCovariancesCoverAsANormalDistributionDoes) {
  std::mt19937_64 random(1);
  const int trials = 2000;
  double one = 0;
  double two = 0;
  int inside = 0;
  double mean_nees = 0;
  for (int trial = 0; trial < trials; ++trial) {
    const Case made = drawn(13, 0.006, random);
    const CheckReport report = check(made.problem, made.solution, made.known).value();
    one += report.share_within_one_sigma / trials;
    two += report.share_within_two_sigma / trials;
    mean_nees += report.joint_nees / trials;
    EXPECT_EQ(report.joint_nees_dof, 39);
    if (report.joint_nees > report.joint_nees_low && report.joint_nees < report.joint_nees_high)
      ++inside;
  }
  EXPECT_NEAR(one, 0.6827, 0.02);
  EXPECT_NEAR(two, 0.9545, 0.01);
  EXPECT_NEAR(mean_nees, 39.0, 4.0 * std::sqrt(2.0 * 39.0 / trials));
  EXPECT_NEAR(inside, 0.99 * trials, 4.0 * std::sqrt(0.0099 * trials));
}

TEST(CheckPoints, CovariancesHalfTooSmallFailTheJointTest) {
  std::mt19937_64 random(2);
  Case made = drawn(13, 0.0, random);
  made.solution.covariances =
      std::make_shared<KnownCovariances>(0.25 * correlated_covariance(made, 0.01));
  const CheckReport report = check(made.problem, made.solution, made.known).value();
  EXPECT_GT(report.joint_nees, report.joint_nees_high);
}

TEST(CheckPoints, FiguresOfAHandWorkedCase) {
  std::mt19937_64 random(3);
  Case made = field(2, random);
  made.solution.points[0].in_enu_m += Eigen::Vector3d(0.03, 0.0, -0.10);
  made.solution.points[1].in_enu_m += Eigen::Vector3d(-0.04, 0.02, 0.0);
  for (auto& point : made.solution.points)
    point.covariance_m2 = Eigen::Vector3d(0.0009, 0.0001, 0.0016).asDiagonal();
  for (auto& point : made.known) point.sigma_m = Eigen::Vector3d(0.04, 0.0, 0.03);
  const CheckReport report = check(made.problem, made.solution, made.known).value();
  EXPECT_NEAR(report.rmse_m.x(), std::sqrt((0.0009 + 0.0016) / 2), 1e-12);
  EXPECT_NEAR(report.rmse_m.z(), std::sqrt(0.01 / 2), 1e-12);
  EXPECT_NEAR(report.largest_m, 0.10, 1e-12);
  EXPECT_TRUE(report.points[0].sigma_m.isApprox(Eigen::Vector3d(0.05, 0.01, 0.05), 1e-12));
  EXPECT_DOUBLE_EQ(report.share_within_one_sigma, 4.0 / 6.0);  // not -0.10, not 0.02
  EXPECT_EQ(report.joint_nees_dof, 0);                         // no joint covariance was handed in
  EXPECT_FALSE(report.best_fit_rmse_m);
}

TEST(CheckPoints, BestFitTakesAwayAnyTurnShiftAndScale) {
  std::mt19937_64 random(4);
  Case made = field(8, random);
  const Eigen::Matrix3d turn =
      Eigen::AngleAxisd(1.1, Eigen::Vector3d(0.2, -0.1, 0.9).normalized()).toRotationMatrix();
  for (auto& point : made.solution.points)
    point.in_enu_m = 1.7 * (turn * point.in_enu_m) + Eigen::Vector3d(5, 6, 7);
  made.problem.photos[0].station.reset();
  const CheckReport report = check(made.problem, made.solution, made.known).value();
  ASSERT_TRUE(report.best_fit_rmse_m);
  EXPECT_LT(report.best_fit_rmse_m->maxCoeff(), 1e-10);
  EXPECT_GT(report.largest_m, 5.0);
  EXPECT_FALSE(report.same_frame);
}

// Noise of 10 mm on 40 points leaves 10 mm, less seven parameters of 120.
TEST(CheckPoints, BestFitLeavesTheNoise) {
  std::mt19937_64 random(5);
  Case made = field(40, random);
  const Eigen::VectorXd noise = 0.01 * standard_normals(120, random);
  for (std::size_t i = 0; i < 40; ++i)
    made.solution.points[i].in_enu_m +=
        Eigen::Vector3d(3, 2, 1) + noise.segment<3>(static_cast<Eigen::Index>(3 * i));
  const CheckReport report = check(made.problem, made.solution, made.known).value();
  ASSERT_TRUE(report.best_fit_rmse_m);
  EXPECT_NEAR(report.best_fit_rmse_m->norm() / std::sqrt(3.0), 0.01 * std::sqrt(113.0 / 120.0),
              3.0 * 0.01 / std::sqrt(240.0));
}

TEST(CheckPoints, PointsNotMeasuredOrUsedAsControlAreNamedAndLeftOut) {
  std::mt19937_64 random(6);
  Case made = field(4, random);
  made.solution.points[1].measured = false;
  made.problem.control.push_back({2, Eigen::Vector3d::Zero(), Eigen::Matrix3d::Identity()});
  made.known.push_back({"elsewhere", Eigen::Vector3d::Zero(), Eigen::Vector3d::Zero()});
  const CheckReport report = check(made.problem, made.solution, made.known).value();
  EXPECT_EQ(report.points.size(), 2u);
  EXPECT_EQ(report.not_measured, (std::vector<std::string>{"P1", "elsewhere"}));
  EXPECT_EQ(report.also_control, std::vector<std::string>{"P2"});
}

TEST(CheckPoints, NothingToCompareIsAnErrorInWords) {
  std::mt19937_64 random(7);
  const Case made = field(2, random);
  const auto report = check(made.problem, made.solution, {{"other", {}, {}}});
  ASSERT_FALSE(report.ok());
  EXPECT_NE(report.error().sentence.find("None of the 1 check points"), std::string::npos);
}

// Three points that define the frame have no variance in six directions (inner constraints).
TEST(CheckPoints, DirectionsWithoutVarianceAreLeftOutOfTheJointTest) {
  std::mt19937_64 random(8);
  Case made = field(5, random);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Identity(15, 15);
  Eigen::MatrixXd shift(15, 3);
  for (int i = 0; i < 5; ++i) shift.block<3, 3>(3 * i, 0).setIdentity();
  const Eigen::MatrixXd free = basis - shift * shift.transpose() / 5.0;
  const Eigen::VectorXd errors = free * standard_normals(15, random) * 0.01;
  for (std::size_t i = 0; i < 5; ++i)
    made.solution.points[i].in_enu_m += errors.segment<3>(static_cast<Eigen::Index>(3 * i));
  made.solution.covariances = std::make_shared<KnownCovariances>(1e-4 * free);
  const CheckReport report = check(made.problem, made.solution, made.known).value();
  EXPECT_EQ(report.joint_nees_dof, 12);
  EXPECT_LT(report.joint_nees, 60.0);
  EXPECT_NEAR(report.joint_nees, errors.squaredNorm() / 1e-4, 1e-6);
}

}  // namespace
}  // namespace plumbline::survey
