// SPDX-License-Identifier: MIT
#include "firmware/config/agreement.h"

#include <cmath>

#include "firmware/config/value.h"

namespace plumbline::config {
namespace {

std::string metres(double value) { return figures(value) + " m"; }

// Steps of 0.1 m from 30 to 90 m end at 90 m, whatever their binary digits.
double count_of(const Heights& heights) {
  return std::floor((heights.last_m - heights.first_m) / heights.step_m + 1e-9) + 1;
}

void settle_heights(Heights& heights, std::vector<Disagreement>& found) {
  if (heights.first_m > heights.last_m) {
    found.push_back({{{"capture", "last_m"}, {"capture", "first_m"}},
                     "last_m (" + metres(heights.last_m) + ") lies below first_m (" +
                         metres(heights.first_m) + "); exchange them, and say the direction " +
                         "with 'direction'."});
    heights = {.list_m = heights.list_m};
  } else if (count_of(heights) > static_cast<double>(kMostHeights)) {
    found.push_back({{{"capture", "step_m"}, {"capture", "last_m"}, {"capture", "first_m"}},
                     "steps of " + metres(heights.step_m) + " from " + metres(heights.first_m) +
                         " to " + metres(heights.last_m) + " are more than " +
                         std::to_string(kMostHeights) + " photos; write a larger step_m."});
    heights = {.list_m = heights.list_m};
  }
}

void settle_release(Config& config, std::vector<Disagreement>& found) {
  capture::ReleaseOptions& release = config.capture.release;
  if (release.release == capture::Release::kNearestFrame &&
      config.camera.id == CameraConfig::kNone) {
    found.push_back({{{"camera", "id"}, {"release", "by"}},
                     "without a camera here nothing takes a photo; write by = \"pulse\" and the "
                     "line to its shutter under [release], or the camera's id."});
    config.camera.id.clear();
  }
  if (release.release == capture::Release::kPulse && config.trigger.line.empty()) {
    found.push_back({{{"release", "by"}, {"release", "line"}},
                     "by = \"pulse\" needs a line; write line = \"/dev/gpiochip0:17\" or the one "
                     "that the shutter is wired to."});
    release.release = capture::Release::kNearestFrame;
  }
  if (!release.is_answered && !config.trigger.feedback_line.empty()) {
    found.push_back({{{"release", "answered"}, {"release", "feedback_line"}},
                     "answered = false says that nothing tells of exposures, but there is a "
                     "feedback_line; leave out one of the two."});
    release.is_answered = true;
  }
  if (release.delay > release.longest_delay) {
    found.push_back({{{"release", "delay_s"}, {"release", "longest_delay_s"}},
                     "delay_s is longer than longest_delay_s; write a larger longest_delay_s."});
    const capture::ReleaseOptions usual;
    release.delay = usual.delay;
    release.longest_delay = usual.longest_delay;
  }
}

void settle_lines(Config& config, std::vector<Disagreement>& found) {
  TriggerConfig& trigger = config.trigger;
  if (trigger.line.empty() || trigger.line != trigger.feedback_line) return;
  found.push_back({{{"release", "feedback_line"}, {"release", "line"}},
                   "line and feedback_line are the same; an input needs a line of its own."});
  trigger.feedback_line.clear();
}

void settle_take_off(Config& config, std::vector<Disagreement>& found) {
  capture::TakeOffOptions& take_off = config.capture.take_off;
  if (take_off.by != capture::TakeOffBy::kHeight && config.pilot.link.empty()) {
    const bool armed = take_off.by == capture::TakeOffBy::kArmed;
    found.push_back({{{"take_off", "by"}, {"pilot", "link"}},
                     std::string("by = \"") + (armed ? "pilot" : "relative_altitude") +
                         "\" needs the autopilot; write its link under [pilot], such as "
                         "link = \"/dev/ttyAMA1@57600\"."});
    take_off.by = capture::TakeOffBy::kHeight;
  }
  if (take_off.landed_below_m >= take_off.rise_m) {
    found.push_back({{{"take_off", "landed_below_m"}, {"take_off", "rise_m"}},
                     "landed_below_m (" + metres(take_off.landed_below_m) +
                         ") is not below rise_m (" + metres(take_off.rise_m) +
                         "), and a flight would end as it begins; write a smaller one."});
    const capture::TakeOffOptions usual;
    take_off.landed_below_m = usual.landed_below_m;
    take_off.rise_m = usual.rise_m;
  }
}

}  // namespace

std::vector<double> heights_of(const Heights& heights) {
  if (!heights.list_m.empty()) return heights.list_m;
  std::vector<double> all;
  const auto count = static_cast<int>(count_of(heights));
  for (int i = 0; i < count; ++i) all.push_back(heights.first_m + i * heights.step_m);
  return all;
}

std::vector<Disagreement> settle(Config& config) {
  std::vector<Disagreement> found;
  settle_heights(config.heights, found);
  settle_lines(config, found);
  settle_release(config, found);
  settle_take_off(config, found);
  config.capture.plan.heights_m = heights_of(config.heights);
  return found;
}

}  // namespace plumbline::config
