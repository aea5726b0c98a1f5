// SPDX-License-Identifier: MIT
#include "tests/edge/orient/paper/test_field.h"

#include <cmath>
#include <numbers>
#include <random>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/paper/priors.h"
#include "edge/orient/three_point_frame.h"

namespace plumbline::orient::testing {
namespace {

// X0, Y0, Z0 in m; omega, phi, kappa as printed: whole and sixtieths.
struct PrintedStation {
  double x, y, z;
  int omega, omega_60, phi, phi_60, kappa, kappa_60;
};
constexpr PrintedStation kTable2[] = {{13.648, -0.619, 74.061, 6, 58, 1, 12, 3, 15},
                                      {13.823, -1.052, 78.676, 6, 43, 1, 15, 3, 0},
                                      {14.302, -1.297, 83.806, 6, 35, 1, 10, 3, 0},
                                      {14.180, -1.528, 89.035, 6, 33, 1, 9, 3, 14},
                                      {14.325, -1.958, 94.142, 6, 28, 0, 59, 2, 58}};
constexpr double kKnownLengthM = 14.831;

class Maker {
 public:
  Maker(const FieldPlan& plan, std::uint64_t seed) : plan_(plan), random_(seed) {}

  TestField make() {
    make_camera();
    make_poses();
    place_targets();
    raise_targets();
    observe();
    field_.problem.lengths.push_back({0, 1, kKnownLengthM, 0.001});
    field_.roles = {0, 1, 2};
    return std::move(field_);
  }

 private:
  double normal(double sigma) { return sigma * std::normal_distribution<double>(0, 1)(random_); }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  void make_camera() {
    geometry::Camera& camera = field_.problem.camera;
    camera.name = "FC350";
    camera.width_px = 4000;
    camera.height_px = 2250;
    camera.interior << 2125, 1999.5, 1124.5, 0, 0, 0, 0, 0, 0, 0;
    const geometry::InteriorVector spread = paper::camera_with(plan_.priors, camera).sigma;
    field_.interior = camera.interior;
    for (int i = 0; i < geometry::kInteriorCount; ++i) field_.interior[i] += normal(spread[i]);
  }

  double angle(int whole, int sixtieths) const {
    const double printed = (whole + sixtieths / 60.0) * kRadPerDeg;
    return plan_.reading == AttitudeReading::kDegreesMinutes ? printed : printed / 60;
  }

  void make_poses() {
    for (const PrintedStation& s : kTable2) {
      field_.poses.push_back(
          {{s.x, s.y, s.z},
           geometry::ground_from_photo(
               {angle(s.omega, s.omega_60), angle(s.phi, s.phi_60), angle(s.kappa, s.kappa_60)})});
      Photo photo;
      photo.name = std::to_string(70 + 5 * field_.problem.photos.size()) + "m";
      field_.problem.photos.push_back(photo);
    }
  }

  std::optional<Eigen::Vector2d> pixel(std::size_t photo, const Eigen::Vector3d& point) const {
    const geometry::Pose& pose = field_.poses[photo];
    const auto at = geometry::project(field_.interior,
                                      pose.ground_from_photo.transpose() * (point - pose.centre_m));
    const bool inside = at && at->x() >= 0 && at->y() >= 0 && at->x() <= 3999 && at->y() <= 2249;
    return inside ? at : std::nullopt;
  }

  bool seen_in_all(const Eigen::Vector3d& point) const {
    for (std::size_t i = 0; i < field_.poses.size(); ++i)
      if (!pixel(i, point)) return false;
    return true;
  }

  void add_target(const std::string& name, const Eigen::Vector3d& place) {
    field_.points.push_back(place);
    field_.problem.point_names.push_back(name);
  }

  void place_targets() {
    add_target("27", Eigen::Vector3d::Zero());
    add_target("35", {kKnownLengthM, 0, 0});
    add_target("62", {12, 25, 0});
    for (int number = 101; static_cast<int>(field_.points.size()) < plan_.targets; ++number) {
      const Eigen::Vector3d place(14 + uniform(-20, 20), uniform(-27.5, 27.5), 0);
      if (seen_in_all(place)) add_target(std::to_string(number), place);
    }
  }

  // Gentle waves and 0.1 m of roughness, scaled; then the three stand where the frame wants them.
  void raise_targets() {
    const double east = uniform(0, 2 * std::numbers::pi), north = uniform(0, 2 * std::numbers::pi);
    std::vector<Eigen::Vector3d> wavy = field_.points;
    for (Eigen::Vector3d& p : wavy)
      p.z() = std::sin(p.x() / plan_.wave_m + east) + std::cos(1.2 * p.y() / plan_.wave_m + north) +
              normal(0.1);
    double factor = plan_.relief_m;
    for (int round = 0; round < 5; ++round) {
      double squares = 0;
      for (std::size_t p = 0; p < wavy.size(); ++p) {
        field_.points[p] = {wavy[p].x(), wavy[p].y(), factor * wavy[p].z()};
      }
      into_frame();
      for (const Eigen::Vector3d& p : field_.points) squares += p.z() * p.z();
      factor *= plan_.relief_m / std::sqrt(squares / static_cast<double>(wavy.size()));
    }
  }

  void into_frame() {
    const auto frame =
        three_point_frame(field_.points[0], field_.points[1], field_.points[2], {0, 0, 80});
    const double scale = kKnownLengthM / frame->x_axis.x();
    for (Eigen::Vector3d& p : field_.points) p = scale * (*frame)(p);
  }

  void observe() {
    for (std::size_t i = 0; i < field_.poses.size(); ++i) {
      for (std::size_t p = 0; p < field_.points.size(); ++p) {
        const auto at = pixel(i, field_.points[p]);
        if (!at) continue;
        Observation o{static_cast<int>(i), static_cast<int>(p)};
        o.pixel = *at + Eigen::Vector2d(normal(plan_.image_sigma_px), normal(plan_.image_sigma_px));
        o.sigma_px = plan_.image_sigma_px;
        o.group = ImageGroup::kStated;
        field_.problem.observations.push_back(o);
      }
    }
  }

  const FieldPlan& plan_;
  std::mt19937_64 random_;
  TestField field_;
};

}  // namespace

TestField make_test_field(const FieldPlan& plan, std::uint64_t seed) {
  return Maker(plan, seed).make();
}

}  // namespace plumbline::orient::testing
