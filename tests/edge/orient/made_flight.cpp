// SPDX-License-Identifier: MIT
#include "tests/edge/orient/made_flight.h"

#include <cmath>
#include <numbers>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"

namespace plumbline::orient::testing {
namespace {

using geometry::InteriorVector;

class Maker {
 public:
  Maker(const FlightPlan& plan, std::uint64_t seed) : plan_(plan), random_(seed) {}

  MadeFlight make() {
    make_camera();
    make_poses();
    make_points();
    observe();
    return std::move(flight_);
  }

 private:
  double normal(double sigma) { return std::normal_distribution<double>(0, 1)(random_) * sigma; }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void make_camera() {
    geometry::Camera& camera = flight_.problem.camera;
    camera.width_px = 4000;
    camera.height_px = 2250;
    flight_.interior << 2125, 2004, 1119, 0, 0, -0.02, 0.01, 0, 2e-4, -1e-4;
    camera.sigma << 0.5, 0.5, 0.5, 0, 0, 2e-4, 2e-4, 0, 2e-4, 2e-4;
    camera.interior = flight_.interior;
    for (int i = 0; i < geometry::kInteriorCount; ++i) {
      camera.interior[i] += normal(camera.sigma[i]);
    }
  }

  void add_photo(double height_m, double along, double aside_m, double yaw_rad) {
    const double bow = plan_.drift_m * 4 * along * (1 - along);
    geometry::Pose pose;
    pose.centre_m = {plan_.drift_m * along + aside_m, bow, height_m};
    pose.ground_from_photo = geometry::ground_from_photo({normal(plan_.tilt_sigma_deg * kRadPerDeg),
                                                          normal(plan_.tilt_sigma_deg * kRadPerDeg),
                                                          yaw_rad + normal(1 * kRadPerDeg)});
    flight_.poses.push_back(pose);
  }

  void make_poses() {
    const double yaw = uniform(-std::numbers::pi, std::numbers::pi);
    const double last = static_cast<double>(plan_.heights_m.size()) - 1;
    for (std::size_t i = 0; i < plan_.heights_m.size(); ++i) {
      add_photo(plan_.heights_m[i], last > 0 ? static_cast<double>(i) / last : 0, 0, yaw);
    }
    if (plan_.side_step_m != 0) add_photo(plan_.heights_m.back(), 1, plan_.side_step_m, yaw);
    const double compass = normal(plan_.heading_sigma_deg * kRadPerDeg);
    for (std::size_t i = 0; i < flight_.poses.size(); ++i) give_photo(i, compass);
  }

  void give_photo(std::size_t i, double compass_rad) {
    Photo photo;
    photo.name = "photo" + std::to_string(i + 1);
    const Eigen::Vector3d sigma(plan_.rtk_sigma_horizontal_m, plan_.rtk_sigma_horizontal_m,
                                plan_.rtk_sigma_vertical_m);
    if (plan_.stations) {
      const Eigen::Vector3d noise(normal(sigma.x()), normal(sigma.y()), normal(sigma.z()));
      photo.station = Station{flight_.poses[i].centre_m + noise,
                              Eigen::Matrix3d(sigma.cwiseAbs2().asDiagonal())};
    }
    if (plan_.heading_sigma_deg > 0) {
      const double kappa = geometry::angles_of(flight_.poses[i].ground_from_photo).kappa_rad;
      photo.heading = HeadingPrior{-kappa + compass_rad, plan_.heading_sigma_deg * kRadPerDeg};
    }
    flight_.problem.photos.push_back(photo);
  }

  // About 40 m by 56 m, as the paper's test field.
  void make_points() {
    for (int i = 0; i < plan_.targets; ++i) {
      const double e = uniform(-20, 20), n = uniform(-28, 28);
      const double hill = std::sin(e / 9) + std::cos(n / 7);
      flight_.points.emplace_back(e, n, 0.5 * plan_.relief_m * hill + normal(0.1));
      flight_.problem.point_names.push_back("P" + std::to_string(i + 1));
    }
  }

  Eigen::Vector2d gross() {
    const double size = uniform(5, 300), direction = uniform(-std::numbers::pi, std::numbers::pi);
    return {size * std::cos(direction), size * std::sin(direction)};
  }

  void observe() {
    for (std::size_t i = 0; i < flight_.poses.size(); ++i) {
      for (std::size_t p = 0; p < flight_.points.size(); ++p) {
        const auto pixel = geometry::project(flight_.interior,
                                             flight_.poses[i].ground_from_photo.transpose() *
                                                 (flight_.points[p] - flight_.poses[i].centre_m));
        if (!pixel || pixel->x() < 0 || pixel->y() < 0 || pixel->x() > 3999 || pixel->y() > 2249) {
          continue;
        }
        Eigen::Vector2d noise(normal(plan_.image_sigma_px), normal(plan_.image_sigma_px));
        if (uniform(0, 1) < plan_.gross_share) noise = gross();
        const double sigma = plan_.group == ImageGroup::kStated ? plan_.image_sigma_px : 1.0;
        flight_.problem.observations.push_back(
            {static_cast<int>(i), static_cast<int>(p), *pixel + noise, sigma, plan_.group});
      }
    }
  }

  const FlightPlan& plan_;
  std::mt19937_64 random_;
  MadeFlight flight_;
};

}  // namespace

MadeFlight make_flight(const FlightPlan& plan, std::uint64_t seed) {
  return Maker(plan, seed).make();
}

}  // namespace plumbline::orient::testing
