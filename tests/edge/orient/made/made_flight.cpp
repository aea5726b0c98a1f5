// SPDX-License-Identifier: MIT
#include "tests/edge/orient/made/made_flight.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

#include "edge/base/index.h"
#include "edge/base/units.h"
#include "edge/geometry/rotation.h"

namespace plumbline::orient::testing {
namespace {

// As the adjustment takes a compass.
constexpr double kOwnHeadingShare = 0.2;

class Maker {
 public:
  Maker(const FlightPlan& plan, std::uint64_t seed)
      : plan_(plan), random_(seed), headings_(~seed) {}

  MadeFlight make() {
    make_camera();
    make_poses();
    make_points();
    observe();
    if (plan_.known_length) add_length();
    return std::move(flight_);
  }

 private:
  double normal(double sigma) { return std::normal_distribution<double>(0, 1)(random_) * sigma; }
  double uniform(double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random_);
  }

  double own_heading(double sigma) {
    return std::normal_distribution<double>(0, 1)(headings_) * sigma;
  }

  void make_camera() {
    geometry::Camera& camera = flight_.problem.camera;
    camera.width_px = 4000;
    camera.height_px = 2250;
    flight_.interior << 2125, 2004, 1119, 0, 0, -0.02, 0.01, 0, 2e-4, -1e-4;
    camera.sigma << plan_.f_sigma * 2125, 0.5, 0.5, 0, 0, 2e-4, 2e-4, 0, 2e-4, 2e-4;
    if (plan_.free_camera)
      camera.sigma << plan_.f_sigma * 2125, 20, 20, 1e-3, 1e-3, 0.02, 0.02, 0.01, 1e-3, 1e-3;
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
    if (plan_.l_step_m != 0) {
      add_photo(plan_.heights_m.back(), 1, plan_.side_step_m, yaw);
      flight_.poses.back().centre_m.y() += plan_.l_step_m;
    }
    const double compass = normal(plan_.heading_sigma_deg * kRadPerDeg);
    for (std::size_t i = 0; i < flight_.poses.size(); ++i) give_photo(i, compass);
    if (plan_.stations) add_shared_gnss_errors();
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
      const double sigma_rad = plan_.heading_sigma_deg * kRadPerDeg;
      photo.heading =
          HeadingPrior{-kappa + compass_rad + own_heading(kOwnHeadingShare * sigma_rad), sigma_rad};
    }
    if (!plan_.speeds_m_s.empty()) {
      photo.velocity_in_enu_m_s = velocity(i);
      photo.station->antenna_in_enu_m -= plan_.delay_s * velocity(i);
    }
    photo.time_s = plan_.photo_interval_s * static_cast<double>(i);
    flight_.problem.photos.push_back(photo);
  }

  // A common offset and a first-order Gauss-Markov process.
  void add_shared_gnss_errors() {
    const GnssErrorModel& gnss = flight_.problem.gnss = plan_.gnss;
    const Eigen::Vector3d offset =
        three(gnss.offset_sigma_horizontal_m, gnss.offset_sigma_vertical_m);
    const auto drift = [&] {
      return three(gnss.correlated_sigma_horizontal_m, gnss.correlated_sigma_vertical_m);
    };
    const double kept =
        gnss.correlation_s > 0 ? std::exp(-plan_.photo_interval_s / gnss.correlation_s) : 0;
    Eigen::Vector3d now = drift();
    for (Photo& photo : flight_.problem.photos) {
      photo.station->antenna_in_enu_m += offset + now;
      now = kept * now + std::sqrt(1 - kept * kept) * drift();
    }
  }
  Eigen::Vector3d three(double horizontal, double vertical) {
    if (horizontal == 0 && vertical == 0) return Eigen::Vector3d::Zero();
    const double e = normal(horizontal), n = normal(horizontal), u = normal(vertical);
    return {e, n, u};
  }

  Eigen::Vector3d velocity(std::size_t photo) const {
    if (plan_.speeds_m_s.empty()) return Eigen::Vector3d::Zero();
    return {0, 0, plan_.speeds_m_s[photo % plan_.speeds_m_s.size()]};
  }

  // Where a pixel of row v is seen from: the pose is that of the middle row.
  std::optional<Eigen::Vector2d> rolled(std::size_t photo, const Eigen::Vector3d& point) const {
    geometry::Pose pose = flight_.poses[photo];
    auto pixel = pixel_in(pose, point);
    constexpr int kRounds = 5;
    for (int round = 0; pixel && plan_.line_time_s != 0 && round < kRounds; ++round) {
      pose.centre_m = flight_.poses[photo].centre_m +
                      plan_.line_time_s * (pixel->y() - (2250 - 1) / 2.0) * velocity(photo);
      pixel = pixel_in(pose, point);
    }
    return pixel;
  }

  // Targets over 40 m by 56 m, as in the paper's test field.
  void make_points() {
    for (int i = 0; i < plan_.targets; ++i) {
      const double e = uniform(-20, 20), n = uniform(-28, 28);
      flight_.points.push_back(ground(e, n));
      flight_.problem.point_names.push_back("P" + std::to_string(i + 1));
    }
    flight_.targets = plan_.targets;
    make_ties();
  }

  Eigen::Vector3d ground(double e, double n) {
    const double hill = std::sin(e / 9) + std::cos(n / 7);
    return {e, n, 0.5 * plan_.relief_m * hill + normal(0.1)};
  }

  // Over the ground of the highest photo, in three photos at least.
  void make_ties() {
    const double half = 0.55 * 4000 / 2125 * plan_.heights_m.back();
    for (int i = 0; i < plan_.ties;) {
      const double e = uniform(-half, half), n = uniform(-half, half);
      const Eigen::Vector3d point = ground(e, n);
      const auto seen = std::count_if(
          flight_.poses.begin(), flight_.poses.end(),
          [&](const geometry::Pose& pose) { return pixel_in(pose, point).has_value(); });
      if (seen < std::min<std::ptrdiff_t>(3, std::ssize(flight_.poses))) continue;
      flight_.points.push_back(point);
      flight_.problem.point_names.push_back("T" + std::to_string(++i));
    }
  }

  std::optional<Eigen::Vector2d> pixel_in(const geometry::Pose& pose,
                                          const Eigen::Vector3d& point) const {
    const auto pixel = geometry::project(
        flight_.interior, pose.ground_from_photo.transpose() * (point - pose.centre_m));
    if (!pixel || pixel->x() < 0 || pixel->y() < 0 || pixel->x() > 3999 || pixel->y() > 2249)
      return std::nullopt;
    return pixel;
  }

  // As No. 27 to No. 35 of the paper: 15 m, one end near the foot.
  void add_length() {
    constexpr double kWantedM = 15, kSigmaM = 0.001;
    Length best{0, 1, 0, kSigmaM};
    double least = std::numeric_limits<double>::infinity();
    for (int a = 0; a < plan_.targets; ++a) {
      for (int b = 0; b < a; ++b) {
        const double metres = (flight_.points[at(a)] - flight_.points[at(b)]).norm();
        const double off = std::abs(metres - kWantedM) + flight_.points[at(a)].head<2>().norm();
        if (off < least) best = {a, b, metres, kSigmaM};
        least = std::min(least, off);
      }
    }
    best.metres += normal(kSigmaM);
    flight_.problem.lengths.push_back(best);
  }

  Eigen::Vector2d gross() {
    const double size = uniform(5, 300), direction = uniform(-std::numbers::pi, std::numbers::pi);
    return {size * std::cos(direction), size * std::sin(direction)};
  }

  void observe() {
    for (std::size_t i = 0; i < flight_.poses.size(); ++i) {
      for (std::size_t p = 0; p < flight_.points.size(); ++p) {
        const auto pixel = rolled(i, flight_.points[p]);
        if (!pixel) continue;
        Eigen::Vector2d noise(normal(plan_.image_sigma_px), normal(plan_.image_sigma_px));
        const bool wrong = uniform(0, 1) < plan_.gross_share;
        if (wrong) noise = gross();
        flight_.gross.push_back(wrong);
        const double sigma = plan_.group == ImageGroup::kStated ? plan_.image_sigma_px : 1.0;
        flight_.problem.observations.push_back(
            {static_cast<int>(i), static_cast<int>(p), *pixel + noise, sigma, plan_.group});
      }
    }
  }

  const FlightPlan& plan_;
  std::mt19937_64 random_;
  std::mt19937_64 headings_;
  MadeFlight flight_;
};

}  // namespace

MadeFlight make_flight(const FlightPlan& plan, std::uint64_t seed) {
  return Maker(plan, seed).make();
}

bool calls_unobservable(const Summary& summary, const std::string& quantity) {
  return std::any_of(summary.unobservable.begin(), summary.unobservable.end(),
                     [&](const Unobservable& u) { return u.name == quantity; });
}

}  // namespace plumbline::orient::testing
