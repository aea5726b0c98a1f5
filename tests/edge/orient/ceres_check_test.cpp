// SPDX-License-Identifier: MIT
// The same adjustment written a second time, from the formulas of the format's description, for
// another solver (Ceres) with other derivatives (automatic): estimates and covariances must agree.
#include <ceres/ceres.h>
#include <gtest/gtest.h>

#include <array>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/adjust.h"
#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient {
namespace {

using testing::FlightPlan;
using testing::MadeFlight;
using testing::make_flight;

// Collinearity with angles as unknowns: R = Rx(omega) Ry(phi) Rz(kappa), photo = R' (P - C).
struct Collinearity {
  Eigen::Vector2d pixel;
  double sigma_px;

  template <typename T>
  bool operator()(const T* interior, const T* centre, const T* angles, const T* point,
                  T* residual) const {
    using std::cos, std::sin;
    const T so = sin(angles[0]), co = cos(angles[0]), sp = sin(angles[1]), cp = cos(angles[1]);
    const T sk = sin(angles[2]), ck = cos(angles[2]);
    const T d[3] = {point[0] - centre[0], point[1] - centre[1], point[2] - centre[2]};
    const T r[3][3] = {{cp * ck, -cp * sk, sp},
                       {co * sk + so * sp * ck, co * ck - so * sp * sk, -so * cp},
                       {so * sk - co * sp * ck, so * ck + co * sp * sk, co * cp}};
    T q[3];
    for (int i = 0; i < 3; ++i) q[i] = r[0][i] * d[0] + r[1][i] * d[1] + r[2][i] * d[2];
    const T x = -q[0] / q[2], y = q[1] / q[2], r2 = x * x + y * y;
    const T radial = 1.0 + r2 * (interior[5] + r2 * (interior[6] + r2 * interior[7]));
    const T xd = x * radial + 2.0 * interior[8] * x * y + interior[9] * (r2 + 2.0 * x * x);
    const T yd = y * radial + interior[8] * (r2 + 2.0 * y * y) + 2.0 * interior[9] * x * y;
    residual[0] = (interior[1] + interior[0] * (xd + interior[4] * yd) - pixel.x()) / sigma_px;
    residual[1] = (interior[2] + interior[0] * (1.0 + interior[3]) * yd - pixel.y()) / sigma_px;
    return true;
  }
};

template <int kSize>
struct Known {
  std::array<double, kSize> value, sigma;
  template <typename T>
  bool operator()(const T* x, T* residual) const {
    for (std::size_t i = 0; i < kSize; ++i) residual[i] = (x[i] - value[i]) / sigma[i];
    return true;
  }
};

struct SecondSolution {
  std::array<double, 10> interior;
  std::vector<std::array<double, 3>> centres, angles, points;
  std::vector<Eigen::Matrix3d> covariances;
};

// The zenith in the photo frame, from the last row of Rx(omega) Ry(phi) Rz(kappa).
struct Level {
  double sigma_rad;
  template <typename T>
  bool operator()(const T* angles, T* residual) const {
    const T east = -cos(angles[0]) * sin(angles[1]);
    const T north = sin(angles[0]);
    residual[0] = (east * cos(angles[2]) + north * sin(angles[2])) / sigma_rad;
    residual[1] = (north * cos(angles[2]) - east * sin(angles[2])) / sigma_rad;
    return true;
  }
};

void add_known(const Problem& problem, SecondSolution& s, ceres::Problem& out) {
  Known<10> camera;
  std::vector<int> fixed;
  for (int i = 0; i < 10; ++i) {
    const auto k = static_cast<std::size_t>(i);
    camera.value[k] = problem.camera.interior[i];
    camera.sigma[k] = problem.camera.sigma[i] > 0 ? problem.camera.sigma[i] : 1;
    if (problem.camera.sigma[i] == 0) fixed.push_back(i);
  }
  out.AddResidualBlock(new ceres::AutoDiffCostFunction<Known<10>, 10, 10>(new Known<10>(camera)),
                       nullptr, s.interior.data());
  out.SetManifold(s.interior.data(), new ceres::SubsetManifold(10, fixed));
  const double tilt = 2 * kRadPerDeg;
  for (std::size_t i = 0; i < problem.photos.size(); ++i) {
    const Station& station = *problem.photos[i].station;
    Known<3> place;
    for (int axis = 0; axis < 3; ++axis) {
      const auto k = static_cast<std::size_t>(axis);
      place.value[k] = station.antenna_in_enu_m[axis];
      place.sigma[k] = std::sqrt(station.covariance_m2(axis, axis) + 1e-8);
    }
    out.AddResidualBlock(new ceres::AutoDiffCostFunction<Known<3>, 3, 3>(new Known<3>(place)),
                         nullptr, s.centres[i].data());
    out.AddResidualBlock(new ceres::AutoDiffCostFunction<Level, 2, 3>(new Level{tilt}), nullptr,
                         s.angles[i].data());
  }
}

SecondSolution solve_with_ceres(const MadeFlight& flight) {
  const Problem& problem = flight.problem;
  SecondSolution s;
  for (int i = 0; i < 10; ++i) s.interior[static_cast<std::size_t>(i)] = problem.camera.interior[i];
  for (const auto& pose : flight.poses) {
    const auto a = geometry::angles_of(pose.ground_from_photo);
    s.centres.push_back({pose.centre_m.x(), pose.centre_m.y(), pose.centre_m.z()});
    s.angles.push_back({a.omega_rad, a.phi_rad, a.kappa_rad});
  }
  for (const auto& p : flight.points) s.points.push_back({p.x(), p.y(), p.z()});
  ceres::Problem out;
  for (const Observation& o : problem.observations) {
    const auto photo = static_cast<std::size_t>(o.photo), point = static_cast<std::size_t>(o.point);
    out.AddResidualBlock(new ceres::AutoDiffCostFunction<Collinearity, 2, 10, 3, 3, 3>(
                             new Collinearity{o.pixel, o.sigma_px}),
                         nullptr, s.interior.data(), s.centres[photo].data(),
                         s.angles[photo].data(), s.points[point].data());
  }
  add_known(problem, s, out);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.max_num_iterations = 200;
  options.function_tolerance = 1e-15;
  options.parameter_tolerance = 1e-14;
  options.gradient_tolerance = 1e-14;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &out, &summary);
  ceres::Covariance covariance({});
  std::vector<std::pair<const double*, const double*>> blocks;
  for (const auto& p : s.points) blocks.emplace_back(p.data(), p.data());
  EXPECT_TRUE(covariance.Compute(blocks, &out));
  for (const auto& p : s.points) {
    Eigen::Matrix<double, 3, 3, Eigen::RowMajor> block;
    covariance.GetCovarianceBlock(p.data(), p.data(), block.data());
    s.covariances.emplace_back(block);
  }
  return s;
}

TEST(Adjust, AgreesWithAnIndependentAdjustmentInCeres) {
  FlightPlan plan;
  plan.targets = 25;
  const MadeFlight flight = make_flight(plan, 42);
  Options no_rejection;
  no_rejection.rejection_sigma = 100;
  no_rejection.bent_error_bars = false;
  const auto ours = adjust(flight.problem, no_rejection);
  ASSERT_TRUE(ours.ok());
  const SecondSolution theirs = solve_with_ceres(flight);
  EXPECT_NEAR(ours->camera.interior[0], theirs.interior[0], 1e-4);
  for (std::size_t p = 0; p < flight.points.size(); ++p) {
    const Eigen::Vector3d other(theirs.points[p].data());
    const Eigen::Matrix3d& covariance = ours->points[p].covariance_m2;
    // To a thousandth of the sigma: what the convergence criteria leave.
    EXPECT_LT((ours->points[p].in_enu_m - other).norm(), 1e-3 * std::sqrt(covariance.trace()));
    EXPECT_LT((covariance - theirs.covariances[p]).norm(), 1e-3 * theirs.covariances[p].norm());
  }
}

}  // namespace
}  // namespace plumbline::orient
