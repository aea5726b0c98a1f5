// SPDX-License-Identifier: MIT
#include "firmware/commands/adjustment_options.h"

#include "firmware/commands/number_check.h"

namespace plumbline::commands {
namespace {

void add_threshold(CLI::App& sub, const char* name, double& value, const char* what) {
  sub.add_option(name, value, what)
      ->check(number_above_zero())
      ->capture_default_str()
      ->group("Beyond which sigma a quantity is called unobservable");
}

}  // namespace

void add_adjustment_options(CLI::App& sub, orient::Options& options) {
  sub.add_option("--tilt-sigma", options.tilt_sigma_deg,
                 "how far from the vertical the camera looks (sigma, degrees) where the photos do "
                 "not say: 2 a stabilised gimbal, 10 a fixed mount")
      ->check(number_within(0.01, 45.0))
      ->capture_default_str();
  add_threshold(sub, "--max-azimuth-sigma", options.max_azimuth_sigma_deg, "degrees");
  add_threshold(sub, "--max-tilt-sigma", options.max_tilt_sigma_deg, "degrees");
  add_threshold(sub, "--max-focal-length-sigma", options.max_focal_length_sigma, "relative");
  add_threshold(sub, "--max-scale-sigma", options.max_scale_sigma, "relative");
  add_threshold(sub, "--max-height-sigma", options.max_height_sigma, "share of the flying height");
  add_threshold(sub, "--max-position-sigma", options.max_position_sigma_m, "metres");
}

}  // namespace plumbline::commands
