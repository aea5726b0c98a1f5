// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera.h"

namespace plumbline {

// A control as V4L2 describes it.
struct V4l2Control {
  std::uint32_t id = 0;
  std::string name;
  std::int64_t minimum = 0;
  std::int64_t maximum = 0;
  std::int64_t step = 1;
  std::int64_t default_value = 0;
  std::int64_t value = 0;
  bool read_only = false;
  std::vector<std::int64_t> menu;  // the choices of a menu
};

struct ControlSetting {
  std::uint32_t id = 0;
  std::int64_t value = 0;
};

struct ControlPlan {
  std::vector<ControlSetting> settings;  // in this order: automatics off before values are set
  std::vector<std::string> notices;      // what cannot be had, for a person
  bool exposure_known = false;           // the control that bounds it is its length, not a bound
};

// How to make `controls` keep to `options`, with nothing that moves or warps the image. `focus`:
// where the lens stood before the camera was opened anew, to put it back. Pure.
ControlPlan plan_controls(const std::vector<V4l2Control>& controls, const CameraOptions& options,
                          std::optional<std::int64_t> focus);

// The value of the exposure control for at most `longest`; nullopt where there is none.
std::optional<ControlSetting> exposure_setting(const std::vector<V4l2Control>& controls,
                                               std::chrono::microseconds longest);

// The control of that id, or nullptr.
const V4l2Control* find_control(const std::vector<V4l2Control>& controls, std::uint32_t id);

}  // namespace plumbline
