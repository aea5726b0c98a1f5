// SPDX-License-Identifier: MIT
#include "tests/soak/day.h"

#include <cmath>
#include <numbers>

namespace plumbline::soak {

using std::chrono::milliseconds;

geodesy::Geodetic place_at(double seconds) {
  return {35.6687242, 139.7627572, 135 - 45 * std::cos(2 * std::numbers::pi * seconds / 60)};
}

sim::GnssStreamOptions stream_options(int hours) {
  using Kind = sim::GnssFault::Kind;
  sim::GnssStreamOptions options;
  options.host_rate_error = 40e-6;
  for (int hour = 0; hour < hours; ++hour) {
    double minute = 10;
    for (const Kind kind :
         {Kind::kSilent, Kind::kNoFix, Kind::kGarbage, Kind::kFloat, Kind::kWrongDigit}) {
      const double from_s = 3600.0 * hour + 60 * minute + 35;
      options.faults.push_back({from_s, from_s + 10, kind, {}});
      minute += 5;
    }
  }
  return options;
}

sim::SimCameraOptions camera_options() {
  sim::SimCameraOptions options;
  options.drop_probability = 0.01;
  options.sigma_stamp = milliseconds(1);
  return options;
}

sim::TriggerLineFaults line_faults() {
  sim::TriggerLineFaults faults;
  faults.doubled = 0.05;
  faults.lost = 0.05;
  faults.jitter_sigma = std::chrono::microseconds(50);
  return faults;
}

}  // namespace plumbline::soak
