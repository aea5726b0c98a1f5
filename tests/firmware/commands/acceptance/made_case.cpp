// SPDX-License-Identifier: MIT
#include "tests/firmware/commands/acceptance/made_case.h"

#include <cmath>
#include <numbers>
#include <optional>

namespace plumbline::acceptance {
namespace {

constexpr double kRtkPlan = 0.005, kRtkHeight = 0.010, kPick = 0.3;
constexpr double kWidth = 4000, kHeight = 2250;

// The lens as it is; camera.toml holds a calibration of it.
struct Lens {
  double f = 2125, u0 = 2004, v0 = 1119, k1 = -0.02, k2 = 0.01, p1 = 2e-4, p2 = -1e-4;
};

// The nine elements of R(omega, phi, kappa), photo frame to ground frame.
Eigen::Matrix3d rotation(const TruePhoto& photo) {
  const double degree = std::numbers::pi / 180;
  const double co = std::cos(photo.omega_deg * degree), so = std::sin(photo.omega_deg * degree);
  const double cp = std::cos(photo.phi_deg * degree), sp = std::sin(photo.phi_deg * degree);
  const double ck = std::cos(photo.kappa_deg * degree), sk = std::sin(photo.kappa_deg * degree);
  Eigen::Matrix3d r;
  r << cp * ck, -cp * sk, sp,                                    //
      co * sk + so * sp * ck, co * ck - so * sp * sk, -so * cp,  //
      so * sk - co * sp * ck, so * ck + co * sp * sk, co * cp;
  return r;
}

std::optional<Eigen::Vector2d> seen_at(const Lens& lens, const TruePhoto& photo,
                                       const Eigen::Vector3d& ground) {
  const Eigen::Matrix3d r = rotation(photo);
  const double dx = ground.x() - photo.centre_m.x(), dy = ground.y() - photo.centre_m.y(),
               dz = ground.z() - photo.centre_m.z();
  const double depth = r(0, 2) * dx + r(1, 2) * dy + r(2, 2) * dz;
  const double right = -(r(0, 0) * dx + r(1, 0) * dy + r(2, 0) * dz) / depth;
  const double down = (r(0, 1) * dx + r(1, 1) * dy + r(2, 1) * dz) / depth;
  const double r2 = right * right + down * down;
  const double radial = 1 + lens.k1 * r2 + lens.k2 * r2 * r2;
  const double x = right * radial + 2 * lens.p1 * right * down + lens.p2 * (r2 + 2 * right * right);
  const double y = down * radial + lens.p1 * (r2 + 2 * down * down) + 2 * lens.p2 * right * down;
  const Eigen::Vector2d pixel(lens.u0 + lens.f * x, lens.v0 + lens.f * y);
  const bool inside =
      pixel.x() > 0 && pixel.y() > 0 && pixel.x() < kWidth - 1 && pixel.y() < kHeight - 1;
  return inside ? std::optional(pixel) : std::nullopt;
}

std::string row(const std::vector<double>& values) {
  std::string text;
  for (const double value : values) text += "," + digits(value);
  return text;
}

std::string place(const Eigen::Vector3d& v) { return row({v.x(), v.y(), v.z()}); }

std::string photo_name(std::size_t i) { return "photo" + std::to_string(i) + ".jpg"; }
std::string point_name(std::size_t i) { return "P" + std::to_string(i); }

class Maker {
 public:
  Maker(const CasePlan& plan, const fs::path& folder)
      : plan_(plan), folder_(folder), random_(plan.seed) {}

  MadeCase make() {
    fly();
    scatter_points();
    write_camera();
    write_photos();
    write_observations();
    write_points("check.csv", 0, 0);
    if (plan_.control) write_points("control.csv", 4, 0.005);
    if (plan_.length) write_length();
    write_gnss();
    return made_;
  }

 private:
  double normal(double sigma) { return sigma * normal_(random_); }
  double uniform(double half) {
    return std::uniform_real_distribution<double>(-half, half)(random_);
  }

  void fly() {
    const double kappa = uniform(180);
    for (const double height : {70., 75., 80., 85., 90., 90.}) {
      const double aside = made_.photos.size() == 5 ? plan_.side_step_m : 0;
      const Eigen::Vector3d centre(normal(0.02) + 0.01 * (height - 70) + aside, normal(0.02),
                                   height + normal(0.1));
      made_.photos.push_back({centre, normal(1), normal(1), kappa + normal(1)});
    }
    if (plan_.side_step_m == 0) made_.photos.pop_back();
  }

  void scatter_points() {
    for (int i = 0; i < 25; ++i) made_.points.emplace_back(uniform(25), uniform(25), uniform(1.5));
  }

  void write_camera() {
    const double f = lens_.f + normal(0.5), u0 = lens_.u0 + normal(0.5),
                 v0 = lens_.v0 + normal(0.5);
    write_text(folder_ / "camera.toml",
               "width_px = 4000\nheight_px = 2250\nfocal_length_px = " + digits(f) +
                   "\nprincipal_point_px = [" + digits(u0) + ", " + digits(v0) +
                   "]\nradial = [-0.02, 0.01, 0.0]\ntangential = [2e-4, -1e-4]\n[sigma]\n"
                   "focal_length_px = 0.5\nprincipal_point_px = [0.5, 0.5]\naffinity = 0\n"
                   "skew = 0\nradial = [0, 0, 0]\ntangential = [0, 0]\nline_time_us = 0\n");
  }

  void write_photos() {
    const double offset = plan_.offset_sigma_m;
    made_.offset_m = {normal(offset), normal(offset), normal(offset)};
    const double compass = normal(plan_.heading_sigma_deg);
    std::string text = "photo";
    if (plan_.stations) text += ",e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m";
    if (plan_.heading_sigma_deg > 0) text += ",heading_deg,sigma_heading_deg";
    for (std::size_t i = 0; i < made_.photos.size(); ++i) {
      text += "\n" + photo_name(i) + (plan_.stations ? station(made_.photos[i]) : "");
      if (plan_.heading_sigma_deg > 0) {
        text += row({compass - made_.photos[i].kappa_deg, plan_.heading_sigma_deg});
      }
    }
    write_text(folder_ / "photos.csv", text + "\n");
  }

  std::string station(const TruePhoto& photo) {
    const Eigen::Vector3d noise(normal(kRtkPlan), normal(kRtkPlan), normal(kRtkHeight));
    const Eigen::Vector3d antenna = photo.centre_m + rotation(photo) * plan_.lever_arm_m;
    return place(Eigen::Vector3d(antenna + made_.offset_m + noise)) +
           row({kRtkPlan, kRtkPlan, kRtkHeight});
  }

  void write_observations() {
    std::string text = "photo,point,u_px,v_px,sigma_px\n";
    for (std::size_t i = 0; i < made_.photos.size(); ++i) {
      for (std::size_t p = 0; p < made_.points.size(); ++p) {
        const auto pixel = seen_at(lens_, made_.photos[i], made_.points[p]);
        if (!pixel) continue;
        text += photo_name(i) + "," + point_name(p) +
                row({pixel->x() + normal(kPick), pixel->y() + normal(kPick), kPick}) + "\n";
      }
    }
    write_text(folder_ / "observations.csv", text);
  }

  // As known with `sigma_m`; count 0: all but those that are control, without a sigma.
  void write_points(const std::string& file, std::size_t count, double sigma_m) {
    std::string text = "point,e_m,n_m,u_m";
    if (count > 0) text += ",sigma_e_m,sigma_n_m,sigma_u_m";
    const std::size_t first = count == 0 && plan_.control ? 4 : 0;
    for (std::size_t p = first; p < (count > 0 ? count : made_.points.size()); ++p) {
      const Eigen::Vector3d noise(normal(sigma_m), normal(sigma_m), normal(sigma_m));
      text += "\n" + point_name(p) + place(Eigen::Vector3d(made_.points[p] + noise));
      if (count > 0) text += row({sigma_m, sigma_m, sigma_m});
    }
    write_text(folder_ / file, text + "\n");
  }

  void write_length() {
    const double length = (made_.points[0] - made_.points[1]).norm() + normal(0.005);
    write_text(folder_ / "lengths.csv",
               "point_a,point_b,length_m,sigma_m\nP0,P1" + row({length, 0.005}) + "\n");
  }

  void write_gnss() {
    if (plan_.offset_sigma_m > 0) {
      const std::string sigma = digits(plan_.offset_sigma_m);
      write_text(folder_ / "gnss.toml", "offset_sigma_m = [" + sigma + ", " + sigma + "]\n");
    }
    if (plan_.lever_arm_m.norm() > 0) {
      const std::string values = place(plan_.lever_arm_m);
      write_text(folder_ / "lever_arm.csv", "right_m,up_m,back_m\n" + values.substr(1) + "\n");
    }
  }

  CasePlan plan_;
  fs::path folder_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  Lens lens_;
  MadeCase made_;
};

}  // namespace

MadeCase write_case(const CasePlan& plan, const fs::path& folder) {
  fs::create_directories(folder);
  return Maker(plan, folder).make();
}

}  // namespace plumbline::acceptance
