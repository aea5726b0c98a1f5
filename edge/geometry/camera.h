// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <limits>
#include <optional>
#include <string>

namespace plumbline::geometry {

// The ten interior parameters, in the order of every 10-vector and 10x10 matrix of this program.
enum Interior {
  kFocalLength,  // principal distance in u pixels
  kPrincipalU,   // px, the centre of the top-left pixel is 0
  kPrincipalV,   // px
  kAffinity,     // fv = f (1 + affinity)
  kSkew,
  kRadial1,  // k1, k2, k3, p1, p2 as in OpenCV: ideal to distorted
  kRadial2,
  kRadial3,
  kTangential1,
  kTangential2,
  kInteriorCount
};
using InteriorVector = Eigen::Matrix<double, kInteriorCount, 1>;
using InteriorMatrix = Eigen::Matrix<double, kInteriorCount, kInteriorCount>;

// The names of the ten in camera.toml's [covariance] order list.
inline constexpr std::array<const char*, kInteriorCount> kInteriorNames = {"focal_length_px",
                                                                           "principal_point_u_px",
                                                                           "principal_point_v_px",
                                                                           "affinity",
                                                                           "skew",
                                                                           "radial_1",
                                                                           "radial_2",
                                                                           "radial_3",
                                                                           "tangential_1",
                                                                           "tangential_2"};

// A prior standard deviation of infinity leaves a parameter free, 0 holds it fixed.
inline constexpr double kFree = std::numeric_limits<double>::infinity();

// A camera and what is known of it before an adjustment, or, after one, what was found.
struct Camera {
  std::string name;
  int width_px = 0;
  int height_px = 0;
  InteriorVector interior = InteriorVector::Zero();
  InteriorVector sigma = InteriorVector::Constant(kFree);
  // Where present it stands for `sigma`; rows of parameters held fixed are zero.
  std::optional<InteriorMatrix> covariance;
  // Rolling shutter: from each row to the one below it, 0 = global. A photo's pose is that of its
  // middle row.
  double line_time_us = 0;
  double line_time_sigma_us = 0;
};

// A pixel and its derivatives.
struct Projection {
  Eigen::Vector2d pixel;
  Eigen::Matrix<double, 2, 3> by_point;  // d pixel / d point_in_photo
  Eigen::Matrix<double, 2, kInteriorCount> by_interior;
};

// Photo frame (x right, y up, z towards the viewer; the point lies at negative z) to pixel:
// x = X / -Z, y = -Y / -Z, Brown distortion (D. C. Brown 1971, coefficients as in OpenCV), then
// u = cu + f (x + skew y), v = cv + f (1 + affinity) y. Empty where the point is not in front
// of the camera (Z >= 0) or lies beyond the radius where the radial distortion folds back.
std::optional<Eigen::Vector2d> project(const InteriorVector& interior,
                                       const Eigen::Vector3d& point_in_photo);
std::optional<Projection> project_with_derivatives(const InteriorVector& interior,
                                                   const Eigen::Vector3d& point_in_photo);

// The direction (x, y, -1) in the photo frame that `pixel` sees: the inverse of project(), to
// 1e-12. Empty where the distortion cannot be inverted.
std::optional<Eigen::Vector3d> ray_in_photo(const InteriorVector& interior,
                                            const Eigen::Vector2d& pixel);

// Pose of a photo: centre in the ground frame and rotation photo -> ground.
struct Pose {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d ground_from_photo = Eigen::Matrix3d::Identity();
};

}  // namespace plumbline::geometry
