// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "sim/gnss_error.h"

namespace plumbline::sim {

enum class Fix { kFixed, kFloat, kSingle };

// A simulated flight in figures. profile_example.toml documents each as a key of a file, with unit
// and default; the defaults here are those of the climb named `paper`.
struct Profile {
  std::string name = "paper";
  // Climb: heights above the ground at its foot, metres.
  double from_m = 70;
  double to_m = 90;
  double step_m = 5;
  // After the top photo, at its height: each leg is turned 90 degrees from the one before.
  std::vector<double> side_steps_m;
  std::optional<double> side_direction_deg;  // of the first leg, from north clockwise; else random
  double drift_m = 0.8;           // slanting off over the whole climb, in a random direction
  double wander_m = 0.01;         // sigma per photo and axis, sideways
  double height_sigma_m = 0.1;    // sigma per photo: the trigger is not exact
  double tilt_sigma_deg = 1;      // of omega and of phi, per photo
  std::optional<double> yaw_deg;  // top of the first photo, from north clockwise; else random
  double yaw_sigma_deg = 1;       // change per photo
  double climb_rate_m_s = 2;
  double pause_s = 2;  // at each photo

  bool gnss = true;
  Fix fix = Fix::kFixed;
  GnssErrorSigmas gnss_error{{0, 0}, {0, 0}, 30, {0.005, 0.010}};
  bool heading = false;          // write the gimbal's yaw
  double heading_sigma_deg = 2;  // of the compass, common to the flight

  int width_px = 4000;
  int height_px = 2250;
  double focal_length_px = 2125;
  double pixel_pitch_um = 1.88;
  std::array<double, 2> principal_offset_px = {7.3, -4.6};
  std::array<double, 3> radial = {-0.02, 0.004, 0};
  std::array<double, 2> tangential = {2e-4, -1.5e-4};
  // Sigmas of the calibration: camera.toml differs from the truth by errors drawn from them.
  double focal_sigma_px = 0.5;
  double principal_sigma_px = 0.5;
  double radial_sigma = 2e-4;  // of k1 and of k2; k3 is known
  double tangential_sigma = 5e-5;

  double blur_px = 0.5;
  double motion_blur_px = 0;
  double noise = 1;  // factor on the sensor's noise: 1 is 1.6 grey levels in mid grey
  double vignetting = 0.18;
  int jpeg_quality = 93;

  int targets = 39;
  std::optional<double> target_diameter_m;  // of the white disc; else to suit the heights
  double pick_sigma_px = 0.1;
  double relief = 1;              // factor on the heights of the ground
  double texture_pixel_m = 0.02;  // of a photo given as ground

  double origin_latitude_deg = 35.36;
  double origin_longitude_deg = 139.13;
  double origin_height_m = 120;  // ellipsoidal, of the ground at the foot
};

// paper: 70 to 90 m every 5 m; standard: 30 to 90 m every 5 m, then 10 m aside; ice: 10 to 60 m
// every 2.5 m, then 5 m aside. Empty for any other name.
std::optional<Profile> named_profile(const std::string& name);

// The same camera with fewer, larger pixels.
Profile with_width(Profile profile, int width_px);

// Sets the kind of fix and the error sigmas that go with it: fixed 5/10 mm white; float some
// decimetres, slowly varying; single one offset of 3 m (5 m in height) and a slow drift.
void set_fix(Profile& profile, Fix fix);

// In one sentence, what makes it impossible to fly; Done where nothing does.
Status check(const Profile& profile);

// A profile file. `name` is the file's name; fails with "name:line: sentence".
Result<Profile> parse_profile(const std::string& toml, const std::string& name);

// "fixed", "float", "single"; empty for any other word.
std::optional<Fix> fix_of(const std::string& word);

// Heights of the photos of the climb, the top last, without the side-steps.
std::vector<double> climb_heights_m(const Profile& profile);

}  // namespace plumbline::sim
