// SPDX-License-Identifier: MIT
#include "sim/profile.h"

#include <cmath>

namespace plumbline::sim {
namespace {

Profile climb(const std::string& name, double from_m, double to_m, double step_m,
              std::vector<double> side_steps_m) {
  Profile profile;
  profile.name = name;
  profile.from_m = from_m;
  profile.to_m = to_m;
  profile.step_m = step_m;
  profile.side_steps_m = std::move(side_steps_m);
  return profile;
}

constexpr int kMostPhotos = 200;

}  // namespace

std::optional<Profile> named_profile(const std::string& name) {
  if (name == "paper") return climb(name, 70, 90, 5, {});
  if (name == "standard") return climb(name, 30, 90, 5, {10});
  if (name == "ice") return climb(name, 10, 60, 2.5, {5});
  return std::nullopt;
}

std::optional<Fix> fix_of(const std::string& word) {
  if (word == "fixed") return Fix::kFixed;
  if (word == "float") return Fix::kFloat;
  if (word == "single") return Fix::kSingle;
  return std::nullopt;
}

Profile with_width(Profile profile, int width_px) {
  const double scale = static_cast<double>(width_px) / profile.width_px;
  profile.width_px = width_px;
  profile.height_px = static_cast<int>(std::lround(profile.height_px * scale));
  profile.focal_length_px *= scale;
  profile.pixel_pitch_um /= scale;
  for (double& offset : profile.principal_offset_px) offset *= scale;
  return profile;
}

void set_fix(Profile& profile, Fix fix) {
  profile.fix = fix;
  switch (fix) {
    case Fix::kFixed:
      profile.gnss_error = {{0, 0}, {0, 0}, 30, {0.005, 0.010}};
      return;
    case Fix::kFloat:
      profile.gnss_error = {{0.3, 0.5}, {0.1, 0.2}, 60, {0.02, 0.04}};
      return;
    case Fix::kSingle:
      profile.gnss_error = {{3, 5}, {0.5, 0.8}, 120, {0.03, 0.06}};
      return;
  }
}

Status check(const Profile& profile) {
  if (profile.to_m < profile.from_m) {
    return Error{"the climb ends at " + std::to_string(profile.to_m) + " m, below its start at " +
                 std::to_string(profile.from_m) + " m: let to_m be at least from_m."};
  }
  const auto photos = climb_heights_m(profile).size() + profile.side_steps_m.size();
  if (photos > kMostPhotos) {
    return Error{"the climb makes " + std::to_string(photos) + " photos, more than " +
                 std::to_string(kMostPhotos) + ": let step_m be larger."};
  }
  return Done{};
}

std::vector<double> climb_heights_m(const Profile& profile) {
  const double steps = std::floor((profile.to_m - profile.from_m) / profile.step_m + 1e-9);
  std::vector<double> heights_m;
  for (double k = 0; k <= std::min(steps, 1e6); ++k) {
    heights_m.push_back(profile.from_m + k * profile.step_m);
  }
  if (profile.to_m - heights_m.back() > 1e-6) heights_m.push_back(profile.to_m);
  return heights_m;
}

}  // namespace plumbline::sim
