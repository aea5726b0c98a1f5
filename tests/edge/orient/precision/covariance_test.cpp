// SPDX-License-Identifier: MIT
#include "edge/orient/precision/covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>
#include <cmath>
#include <numeric>

#include "edge/orient/precision/local_frame_fit.h"
#include "edge/orient/reliability/group_fits.h"
#include "tests/edge/orient/made/small_network.h"

namespace plumbline::orient {
namespace {

using testing::DenseSystem;
using testing::SmallNetwork;

// The factored covariance beside the inverse of the whole normal matrix.
struct Both {
  explicit Both(const SmallNetwork& small)
      : rays(linearise_rays(small.network, small.state, 0)),
        terms(linearised_terms(small.network, small.state, small.datum, small.options)),
        factored(*NetworkCovariance::of(small.network,
                                        normal_equations(small.network, small.state, 0, terms))),
        system(small.network, rays.rays, terms),
        dense(system.covariance()) {}

  Eigen::MatrixXd dense_joint(const std::vector<int>& points) const {
    std::vector<int> columns;
    for (const int p : points) {
      for (int i = 0; i < 3; ++i) columns.push_back(system.column_of_point(p) + i);
    }
    return dense(columns, columns);
  }

  RaysLinear rays;
  std::vector<Term> terms;
  NetworkCovariance factored;
  DenseSystem system;
  Eigen::MatrixXd dense;
};

// Each entry against the sigmas of its row and column.
void expect_alike(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double share) {
  ASSERT_EQ(a.rows(), b.rows());
  const Eigen::VectorXd sigma = b.diagonal().cwiseMax(0).cwiseSqrt();
  for (Eigen::Index i = 0; i < a.rows(); ++i) {
    for (Eigen::Index j = 0; j < a.cols(); ++j) {
      EXPECT_LE(std::abs(a(i, j) - b(i, j)), share * sigma[i] * sigma[j]) << i << ' ' << j;
    }
  }
}

std::vector<int> all_points(const Network& network) {
  std::vector<int> points(at(network.points()));
  std::iota(points.begin(), points.end(), 0);
  return points;
}

TEST(NetworkCovariance, IsTheInverseOfTheWholeNormalMatrix) {
  for (const std::uint64_t seed : {21U, 22U}) {
    const SmallNetwork small(seed);
    const Both both(small);
    const auto columns = small.network.layout.columns();
    expect_alike(both.factored.common(), both.dense.topLeftCorner(columns, columns), 1e-6);
    const std::vector<int> points = all_points(small.network);
    expect_alike(both.factored.joint(points), both.dense_joint(points), 1e-6);
    expect_alike(both.factored.joint({7, 1, 6}), both.dense_joint({7, 1, 6}), 1e-6);
    for (const int p : points) {
      expect_alike(both.factored.point_covariance(p), both.dense_joint({p}), 1e-6);
    }
  }
}

TEST(NetworkCovariance, IsThatInverseForPointsOfDifferentPhotosAllAtOnce) {
  SmallNetwork small(28, 30);
  std::erase_if(small.problem.observations,
                [](const Observation& o) { return (o.point + o.photo) % 4 == 0; });
  Observation again = small.problem.observations.front();
  again.pixel.x() += 0.3;
  small.problem.observations.push_back(again);
  small.tie_again();
  const Both both(small);
  const auto covariances = both.factored.point_covariances();
  for (const int p : all_points(small.network)) {
    expect_alike(covariances[at(p)], both.dense_joint({p}), 1e-6);
  }
}

TEST(NetworkCovariance, CarriesItselfToThePixelOfARay) {
  const SmallNetwork small(23);
  const Both both(small);
  for (std::size_t k = 0; k < both.rays.rays.size(); ++k) {
    const Ray& ray = small.network.rays[k];
    const RayLinear& linear = both.rays.rays[k];
    Eigen::MatrixXd jacobian = Eigen::MatrixXd::Zero(2, both.dense.cols());
    jacobian.leftCols<kShared>() = linear.by_common.leftCols<kShared>();
    jacobian.middleCols<6>(small.network.layout.photo(ray.slot)) = linear.by_common.rightCols<6>();
    jacobian.middleCols<3>(both.system.column_of_point(ray.point)) = linear.by_point;
    expect_alike(
        both.factored.pixel_covariance(small.network, ray, linear, both.factored.spread(ray.point)),
        jacobian * both.dense * jacobian.transpose(), 1e-6);
  }
}

TEST(NetworkCovariance, MakesRedundanciesAddUpToObservationsMinusUnknowns) {
  SmallNetwork small(24);
  small.network.rays[5].used = false;
  const Both both(small);
  const GroupFits fits = group_fits(small.network, both.factored, both.rays.rays, both.terms);
  double redundancy = 0;
  int observations = 0;
  for (const auto& [name, fit] : fits) {
    EXPECT_GE(fit.redundancy, -1e-6) << name;
    EXPECT_LE(fit.redundancy, fit.observations) << name;
    redundancy += fit.redundancy;
    observations += fit.observations;
  }
  const double unknowns =
      small.network.shared_mask.sum() + 6 * small.network.slots() + 3 * small.network.points();
  EXPECT_NEAR(redundancy, observations - unknowns, 1e-5);
}

// The similarity of the points about their centroid, by its definition, all points at once.
Eigen::MatrixXd similarity_design(const State& state, const std::vector<int>& points) {
  Eigen::Vector3d centroid = Eigen::Vector3d::Zero();
  for (const int p : points) centroid += state.points[at(p)] / static_cast<double>(points.size());
  Eigen::MatrixXd g(3 * points.size(), 7);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector3d x = state.points[at(points[i])] - centroid;
    Eigen::Matrix3d turn;
    for (int axis = 0; axis < 3; ++axis) turn.col(axis) = Eigen::Vector3d::Unit(axis).cross(x);
    g.middleRows<3>(static_cast<Eigen::Index>(3 * i)) << Eigen::Matrix3d::Identity(), turn, x;
  }
  return g;
}

// The S-transformation written out: c = (G'G)^-1 G' dx, local = (I - G (G'G)^-1 G') dx.
TEST(LocalFrame, SplitsTheCovarianceAsTheDenseTransformationDoes) {
  const SmallNetwork small(25);
  const Both both(small);
  const std::vector<int> points = all_points(small.network);
  std::vector<Eigen::Matrix3d> covariances;
  for (const int p : points) covariances.push_back(both.factored.point_covariance(p));
  std::vector<double> traces;
  for (const auto& c : covariances) traces.push_back(c.trace());
  std::sort(traces.begin(), traces.end());
  ASSERT_LT(traces.back(), 8 * traces[traces.size() / 2]) << "all points should define the frame";
  const LocalFrameFit fit = fit_local_frame(small.state, both.factored, covariances);
  const Eigen::MatrixXd g = similarity_design(small.state, points);
  const Eigen::MatrixXd fitted = (g.transpose() * g).inverse() * g.transpose();
  const Eigen::MatrixXd joint = both.dense_joint(points);
  expect_alike(fit.common_covariance, fitted * joint * fitted.transpose(), 1e-5);
  const Eigen::MatrixXd rest = Eigen::MatrixXd::Identity(g.rows(), g.rows()) - g * fitted;
  const Eigen::MatrixXd local = rest * joint * rest.transpose();
  for (const int p : points) {
    expect_alike(fit.local_covariance_m2[at(p)], local.block<3, 3>(3 * p, 3 * p), 1e-4);
  }
}

TEST(NetworkCovariance, IsAbsentWhereNothingHoldsAPhoto) {
  SmallNetwork small(26);
  EXPECT_FALSE(
      NetworkCovariance::of(small.network, normal_equations(small.network, small.state, 0, {})));
}

}  // namespace
}  // namespace plumbline::orient
