// SPDX-License-Identifier: MIT
#include "drivers/camera/control_plan.h"

#include <linux/v4l2-controls.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace plumbline {
namespace {

// V4L2_CID_HDR_SENSOR_MODE of Linux 6.3, which older headers lack.
constexpr std::uint32_t kHdrSensorMode = V4L2_CID_CAMERA_CLASS_BASE + 36;

// EXPOSURE_ABSOLUTE counts in these.
constexpr std::int64_t kExposureUnitUs = 100;

// Controls that move, crop, mirror or merge the image, with the value at which they do not; at its
// default where nullopt. Those that a camera lacks are passed over.
struct Still {
  std::uint32_t id;
  std::optional<std::int64_t> value;
};
constexpr std::array<Still, 13> kStill = {{
    {V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0},  // else it lowers the frame rate in poor light
    {V4L2_CID_IMAGE_STABILIZATION, 0},
    {V4L2_CID_WIDE_DYNAMIC_RANGE, 0},
    {kHdrSensorMode, 0},
    {V4L2_CID_SCENE_MODE, V4L2_SCENE_MODE_NONE},
    {V4L2_CID_FOCUS_AUTO, 0},
    {V4L2_CID_ZOOM_CONTINUOUS, 0},
    {V4L2_CID_ZOOM_ABSOLUTE, std::nullopt},
    {V4L2_CID_PAN_ABSOLUTE, std::nullopt},
    {V4L2_CID_TILT_ABSOLUTE, std::nullopt},
    {V4L2_CID_HFLIP, 0},
    {V4L2_CID_VFLIP, 0},
    {V4L2_CID_ROTATE, 0},
}};

bool offers(const V4l2Control& control, std::int64_t choice) {
  return std::find(control.menu.begin(), control.menu.end(), choice) != control.menu.end();
}

const V4l2Control* writable(const std::vector<V4l2Control>& controls, std::uint32_t id) {
  const V4l2Control* control = find_control(controls, id);
  return control != nullptr && !control->read_only ? control : nullptr;
}

void keep_still(const std::vector<V4l2Control>& controls, ControlPlan& plan) {
  for (const Still& still : kStill) {
    const V4l2Control* control = writable(controls, still.id);
    if (control == nullptr) continue;
    plan.settings.push_back({still.id, still.value.value_or(control->default_value)});
  }
}

void lock_focus(const std::vector<V4l2Control>& controls, const CameraOptions& options,
                std::optional<std::int64_t> focus, ControlPlan& plan) {
  const V4l2Control* control = writable(controls, V4L2_CID_FOCUS_ABSOLUTE);
  if (control != nullptr && focus) plan.settings.push_back({V4L2_CID_FOCUS_ABSOLUTE, *focus});
  if (!options.lens_position_dioptre) return;
  plan.notices.push_back(
      control == nullptr
          ? "The camera cannot set its focus; it stays as the lens is."
          : "The camera's focus has no known unit, so that dioptres cannot be set; it is locked "
            "where it stands.");
}

// Who varies the gain: the camera, where it can and may.
void set_gain(const std::vector<V4l2Control>& controls, const CameraOptions& options,
              bool exposure_is_fixed, ControlPlan& plan) {
  const V4l2Control* automatic = writable(controls, V4L2_CID_AUTOGAIN);
  const V4l2Control* gain = writable(controls, V4L2_CID_GAIN);
  if (gain == nullptr) gain = writable(controls, V4L2_CID_ANALOGUE_GAIN);
  if (automatic != nullptr) {
    plan.settings.push_back({V4L2_CID_AUTOGAIN, options.fixed_gain ? 0 : 1});
  }
  if (options.fixed_gain && gain != nullptr) {
    const auto steps = static_cast<std::int64_t>(std::llround(*options.fixed_gain));
    plan.settings.push_back({gain->id, std::clamp(steps, gain->minimum, gain->maximum)});
    plan.notices.push_back("The gain is set in the camera's own steps (" +
                           std::to_string(gain->minimum) + " to " + std::to_string(gain->maximum) +
                           "): V4L2 knows no unit of gain.");
  } else if (options.fixed_gain) {
    plan.notices.push_back("The camera cannot set its gain; it may vary.");
  } else if (automatic == nullptr && exposure_is_fixed) {
    plan.notices.push_back(
        "The camera cannot suit its gain to the light while its exposure is limited: brightness "
        "is as the exposure makes it.");
  }
}

enum class ExposureControl { kNone, kManual, kShutterPriority };

ExposureControl set_exposure_mode(const std::vector<V4l2Control>& controls,
                                  const CameraOptions& options, ControlPlan& plan) {
  const bool has_length = writable(controls, V4L2_CID_EXPOSURE_ABSOLUTE) != nullptr;
  if (!has_length) {
    plan.notices.push_back(
        "The camera cannot limit its exposure: photos may blur, and their time is less certain.");
    return ExposureControl::kNone;
  }
  const V4l2Control* mode = writable(controls, V4L2_CID_EXPOSURE_AUTO);
  if (mode == nullptr) return ExposureControl::kManual;
  const bool priority = !options.fixed_exposure && !options.fixed_gain &&
                        offers(*mode, V4L2_EXPOSURE_SHUTTER_PRIORITY);
  plan.settings.push_back(
      {mode->id, priority ? V4L2_EXPOSURE_SHUTTER_PRIORITY : V4L2_EXPOSURE_MANUAL});
  return priority ? ExposureControl::kShutterPriority : ExposureControl::kManual;
}

void limit_exposure(const std::vector<V4l2Control>& controls, const CameraOptions& options,
                    ControlPlan& plan) {
  const std::optional<ControlSetting> setting =
      exposure_setting(controls, options.longest_exposure);
  if (!setting) return;
  plan.settings.push_back(*setting);
  plan.exposure_known = true;
  const std::int64_t us = setting->value * kExposureUnitUs;
  if (us <= options.longest_exposure.count()) return;
  plan.notices.push_back(
      "The camera's shortest exposure is " + std::to_string(us) + " us, longer than the " +
      std::to_string(options.longest_exposure.count()) + " us that blur allows.");
}

}  // namespace

const V4l2Control* find_control(const std::vector<V4l2Control>& controls, std::uint32_t id) {
  const auto at = std::find_if(controls.begin(), controls.end(),
                               [id](const V4l2Control& control) { return control.id == id; });
  return at == controls.end() ? nullptr : &*at;
}

std::optional<ControlSetting> exposure_setting(const std::vector<V4l2Control>& controls,
                                               std::chrono::microseconds longest) {
  const V4l2Control* control = writable(controls, V4L2_CID_EXPOSURE_ABSOLUTE);
  if (control == nullptr) return std::nullopt;
  const std::int64_t step = std::max<std::int64_t>(control->step, 1);
  const std::int64_t wanted =
      std::clamp(static_cast<std::int64_t>(longest.count()) / kExposureUnitUs, control->minimum,
                 control->maximum);
  const std::int64_t on_step = control->minimum + (wanted - control->minimum) / step * step;
  return ControlSetting{control->id, on_step};
}

ControlPlan plan_controls(const std::vector<V4l2Control>& controls, const CameraOptions& options,
                          std::optional<std::int64_t> focus) {
  ControlPlan plan;
  keep_still(controls, plan);
  lock_focus(controls, options, focus, plan);
  const ExposureControl mode = set_exposure_mode(controls, options, plan);
  if (mode != ExposureControl::kNone) limit_exposure(controls, options, plan);
  set_gain(controls, options, mode == ExposureControl::kManual, plan);
  return plan;
}

}  // namespace plumbline
