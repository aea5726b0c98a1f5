// SPDX-License-Identifier: MIT
#include "edge/geometry/rotation.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <random>

#include "edge/base/units.h"

namespace plumbline::geometry {
namespace {

// The three matrices of Kunii and Kumazaki's eq. 3, typed from the paper element by element.
Eigen::Matrix3d as_printed(double o, double p, double k) {
  Eigen::Matrix3d rx, ry, rz;
  rx << 1, 0, 0, 0, std::cos(o), -std::sin(o), 0, std::sin(o), std::cos(o);
  ry << std::cos(p), 0, std::sin(p), 0, 1, 0, -std::sin(p), 0, std::cos(p);
  rz << std::cos(k), -std::sin(k), 0, std::sin(k), std::cos(k), 0, 0, 0, 1;
  return rx * ry * rz;
}

TEST(Rotation, IsThePapersProductOfThreeMatrices) {
  const OmegaPhiKappa angles{0.3, -0.2, 2.5};
  EXPECT_TRUE(ground_from_photo(angles).isApprox(as_printed(0.3, -0.2, 2.5), 1e-15));
}

TEST(Rotation, TurnsTheTopOfThePhotoWestForKappaPlusNinety) {
  const Eigen::Vector3d top = ground_from_photo({0, 0, 90 * kRadPerDeg}) * Eigen::Vector3d::UnitY();
  EXPECT_TRUE(top.isApprox(Eigen::Vector3d(-1, 0, 0), 1e-12));
}

TEST(Rotation, GivesItsAnglesBack) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> angle(-3.1, 3.1), half(-1.5, 1.5);
  for (int i = 0; i < 100; ++i) {
    const OmegaPhiKappa in{angle(random), half(random), angle(random)};
    const OmegaPhiKappa out = angles_of(ground_from_photo(in));
    EXPECT_NEAR(out.omega_rad, in.omega_rad, 1e-12);
    EXPECT_NEAR(out.phi_rad, in.phi_rad, 1e-12);
    EXPECT_NEAR(out.kappa_rad, in.kappa_rad, 1e-12);
  }
}

TEST(Rotation, DerivativeOfTheAnglesAgreesWithDifferences) {
  const OmegaPhiKappa angles{0.1, -0.25, 1.2};
  const Eigen::Matrix3d derivative = angles_by_ground_increment(angles);
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
    const auto plus = angles_of(rotation_by(step) * ground_from_photo(angles));
    const auto minus = angles_of(rotation_by(-step) * ground_from_photo(angles));
    const Eigen::Vector3d difference(plus.omega_rad - minus.omega_rad, plus.phi_rad - minus.phi_rad,
                                     plus.kappa_rad - minus.kappa_rad);
    EXPECT_LT((difference / (2 * kStep) - derivative.col(axis)).norm(), 1e-8);
  }
}

TEST(Rotation, ByAVectorIsTheExponentialOfItsCrossMatrix) {
  const Eigen::Vector3d v(0.01, -0.02, 0.03);
  const Eigen::Matrix3d k = cross_matrix(v);
  const Eigen::Matrix3d series =
      Eigen::Matrix3d::Identity() + k + k * k / 2 + k * k * k / 6 + k * k * k * k / 24;
  EXPECT_LT((rotation_by(v) - series).norm(), 1e-9);
  EXPECT_TRUE((k * Eigen::Vector3d(1, 2, 3)).isApprox(v.cross(Eigen::Vector3d(1, 2, 3))));
}

TEST(Rotation, VectorsChangeByIncrementsAsTheirDerivativeSays) {
  const auto vector_of = [](const Eigen::Matrix3d& rotation) -> Eigen::Vector3d {
    const Eigen::AngleAxisd turn(rotation);
    return turn.angle() * turn.axis();
  };
  for (const double size : {1e-5, 0.01, 0.6, 2.5}) {
    const Eigen::Vector3d vector = size * Eigen::Vector3d(0.6, -0.48, 0.64);
    const Eigen::Matrix3d derivative = rotation_vector_by_increment(vector);
    for (int axis = 0; axis < 3; ++axis) {
      constexpr double kStep = 1e-6;
      const Eigen::Vector3d step = kStep * Eigen::Vector3d::Unit(axis);
      const Eigen::Vector3d difference = vector_of(rotation_by(step) * rotation_by(vector)) -
                                         vector_of(rotation_by(-step) * rotation_by(vector));
      EXPECT_LT((difference / (2 * kStep) - derivative.col(axis)).norm(), 1e-7) << size;
    }
  }
}

}  // namespace
}  // namespace plumbline::geometry
