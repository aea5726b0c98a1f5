// SPDX-License-Identifier: MIT
#include "tests/bench/ceres_adjustment.h"

#include <ceres/ceres.h>

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"

namespace plumbline::bench {

namespace {

constexpr int kInterior = geometry::kInteriorCount;

template <typename T>
using Vector3 = Eigen::Matrix<T, 3, 1>;

// The model of edge/geometry/camera.h, written a second time for automatic derivatives.
template <typename T>
Eigen::Matrix<T, 2, 1> project(const T* c, const Vector3<T>& in_photo) {
  const T x = in_photo.x() / -in_photo.z();
  const T y = -in_photo.y() / -in_photo.z();
  const T r2 = x * x + y * y;
  const T radial = T(1) + r2 * (c[geometry::kRadial1] +
                                r2 * (c[geometry::kRadial2] + r2 * c[geometry::kRadial3]));
  const T p1 = c[geometry::kTangential1];
  const T p2 = c[geometry::kTangential2];
  const T xd = x * radial + T(2) * p1 * x * y + p2 * (r2 + T(2) * x * x);
  const T yd = y * radial + p1 * (r2 + T(2) * y * y) + T(2) * p2 * x * y;
  const T f = c[geometry::kFocalLength];
  return {c[geometry::kPrincipalU] + f * (xd + c[geometry::kSkew] * yd),
          c[geometry::kPrincipalV] + f * (T(1) + c[geometry::kAffinity]) * yd};
}

template <typename T>
Eigen::Matrix<T, 3, 3> ground_from_photo(const T* angles) {
  using Axis = Eigen::AngleAxis<T>;
  return (Axis(angles[0], Vector3<T>::UnitX()) * Axis(angles[1], Vector3<T>::UnitY()) *
          Axis(angles[2], Vector3<T>::UnitZ()))
      .toRotationMatrix();
}

struct Reprojection {
  template <typename T>
  bool operator()(const T* interior, const T* photo, const T* point, T* residual) const {
    const Vector3<T> ray(point[0] - photo[3], point[1] - photo[4], point[2] - photo[5]);
    const Vector3<T> in_photo = ground_from_photo(photo).transpose() * ray;
    const Eigen::Matrix<T, 2, 1> pixel = project(interior, in_photo);
    residual[0] = (pixel[0] - T(measured.x())) / T(sigma_px);
    residual[1] = (pixel[1] - T(measured.y())) / T(sigma_px);
    return true;
  }
  Eigen::Vector2d measured;
  double sigma_px;
};

// A station and the prior of tilt.
struct PhotoPrior {
  template <typename T>
  bool operator()(const T* photo, T* residual) const {
    const Vector3<T> difference(photo[3] - T(station.antenna_in_enu_m.x()),
                                photo[4] - T(station.antenna_in_enu_m.y()),
                                photo[5] - T(station.antenna_in_enu_m.z()));
    Eigen::Map<Vector3<T>>(residual, 3) = whitening.cast<T>() * difference;
    residual[3] = photo[0] / T(tilt_sigma_rad);
    residual[4] = photo[1] / T(tilt_sigma_rad);
    return true;
  }
  orient::Station station;
  Eigen::Matrix3d whitening;
  double tilt_sigma_rad;
};

struct InteriorPrior {
  template <typename T>
  bool operator()(const T* interior, T* residual) const {
    for (int i = 0; i < kInterior; ++i) {
      const bool held = camera.sigma[i] == 0;
      residual[i] = held ? T(0) : (interior[i] - T(camera.interior[i])) / T(camera.sigma[i]);
    }
    return true;
  }
  geometry::Camera camera;
};

void add_reprojections(const orient::Problem& from, CeresState& state, ceres::Problem& to) {
  for (const orient::Observation& seen : from.observations) {
    to.AddResidualBlock(new ceres::AutoDiffCostFunction<Reprojection, 2, kInterior, 6, 3>(
                            new Reprojection{seen.pixel, seen.sigma_px}),
                        nullptr, state.interior.data(),
                        state.photos[static_cast<std::size_t>(seen.photo)].data(),
                        state.points[static_cast<std::size_t>(seen.point)].data());
  }
}

void add_priors(const orient::Problem& from, double tilt_sigma_rad, CeresState& state,
                ceres::Problem& to) {
  for (std::size_t i = 0; i < from.photos.size(); ++i) {
    const orient::Station& station = from.photos[i].station.value();
    const Eigen::Matrix3d factor = station.covariance_m2.llt().matrixL();
    to.AddResidualBlock(new ceres::AutoDiffCostFunction<PhotoPrior, 5, 6>(
                            new PhotoPrior{station, factor.inverse(), tilt_sigma_rad}),
                        nullptr, state.photos[i].data());
  }
  to.AddResidualBlock(new ceres::AutoDiffCostFunction<InteriorPrior, kInterior, kInterior>(
                          new InteriorPrior{from.camera}),
                      nullptr, state.interior.data());
  std::vector<int> held;
  for (int i = 0; i < kInterior; ++i) {
    if (from.camera.sigma[i] == 0) held.push_back(i);
  }
  to.SetManifold(state.interior.data(), new ceres::SubsetManifold(kInterior, held));
}

// Small numbers in [-1, 1] without any library's opinion of randomness.
class Jitter {
 public:
  double operator()() {
    state_ = state_ * 6364136223846793005ULL + 1442695040888963407ULL;
    return static_cast<double>(state_ >> 33U) / static_cast<double>(1ULL << 30U) - 1;
  }

 private:
  std::uint64_t state_ = 1;
};

}  // namespace

CeresState start_near_truth(const orient::testing::MadeFlight& flight) {
  Jitter jitter;
  CeresState state;
  const geometry::InteriorVector& interior = flight.problem.camera.interior;
  for (int i = 0; i < kInterior; ++i) state.interior[static_cast<std::size_t>(i)] = interior[i];
  for (const geometry::Pose& pose : flight.poses) {
    const auto angles = geometry::angles_of(pose.ground_from_photo);
    const double off_rad = 0.5 * kRadPerDeg;
    state.photos.push_back({angles.omega_rad + off_rad * jitter(),
                            angles.phi_rad + off_rad * jitter(),
                            angles.kappa_rad + off_rad * jitter(), pose.centre_m.x() + jitter(),
                            pose.centre_m.y() + jitter(), pose.centre_m.z() + jitter()});
  }
  for (const Eigen::Vector3d& point : flight.points) {
    state.points.push_back({point.x() + jitter(), point.y() + jitter(), point.z() + jitter()});
  }
  return state;
}

bool solve_with_ceres(const orient::Problem& problem, double tilt_sigma_rad, CeresState& state) {
  ceres::Problem ceres_problem;
  add_reprojections(problem, state, ceres_problem);
  add_priors(problem, tilt_sigma_rad, state, ceres_problem);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_SCHUR;
  options.num_threads = 1;
  options.max_num_iterations = 200;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &ceres_problem, &summary);
  return summary.termination_type == ceres::CONVERGENCE;
}

}  // namespace plumbline::bench
