// SPDX-License-Identifier: MIT
#pragma once

#include <ceres/ceres.h>
#include <ceres/rotation.h>

#include <Eigen/Core>

#include "edge/orient/problem.h"

namespace plumbline::bench {

// The cost functions of the comparison, with automatic derivatives.

inline constexpr int kInterior = geometry::kInteriorCount;

// The model of edge/geometry/camera.h, written a second time.
struct Reprojection {
  template <typename T>
  bool operator()(const T* c, const T* photo, const T* point, T* residual) const {
    const T ray[3] = {point[0] - photo[3], point[1] - photo[4], point[2] - photo[5]};
    T q[3];
    ceres::AngleAxisRotatePoint(photo, ray, q);
    const T x = q[0] / -q[2];
    const T y = -q[1] / -q[2];
    const T r2 = x * x + y * y;
    const T radial = 1.0 + r2 * (c[geometry::kRadial1] +
                                 r2 * (c[geometry::kRadial2] + r2 * c[geometry::kRadial3]));
    const T& p1 = c[geometry::kTangential1];
    const T& p2 = c[geometry::kTangential2];
    const T xd = x * radial + 2.0 * p1 * x * y + p2 * (r2 + 2.0 * x * x);
    const T yd = y * radial + p1 * (r2 + 2.0 * y * y) + 2.0 * p2 * x * y;
    const T& f = c[geometry::kFocalLength];
    const T u = c[geometry::kPrincipalU] + f * (xd + c[geometry::kSkew] * yd);
    const T v = c[geometry::kPrincipalV] + f * (1.0 + c[geometry::kAffinity]) * yd;
    residual[0] = (u - measured.x()) / sigma_px;
    residual[1] = (v - measured.y()) / sigma_px;
    return true;
  }
  Eigen::Vector2d measured;
  double sigma_px;
};

// A station and the prior of tilt.
struct PhotoPrior {
  template <typename T>
  bool operator()(const T* photo, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (photo[3 + i] - station[i]) / station_sigma_m;
    T photo_from_ground[9];  // column major: the rows of its transpose
    ceres::AngleAxisToRotationMatrix(photo, photo_from_ground);
    // The zenith in the photo frame: its last column.
    residual[3] = photo_from_ground[6] / tilt_sigma_rad;
    residual[4] = photo_from_ground[7] / tilt_sigma_rad;
    return true;
  }
  Eigen::Vector3d station;
  double station_sigma_m;
  double tilt_sigma_rad;
};

struct ControlPrior {
  template <typename T>
  bool operator()(const T* point, T* residual) const {
    for (int i = 0; i < 3; ++i) residual[i] = (point[i] - known[i]) / sigma_m;
    return true;
  }
  Eigen::Vector3d known;
  double sigma_m;
};

struct InteriorPrior {
  template <typename T>
  bool operator()(const T* interior, T* residual) const {
    for (int i = 0; i < kInterior; ++i)
      residual[i] = (interior[i] - camera.interior[i]) / camera.sigma[i];
    return true;
  }
  const geometry::Camera& camera;
};

}  // namespace plumbline::bench
