// SPDX-License-Identifier: MIT
#include "drivers/camera/libcamera_module/libcamera_settings.h"

#include <libcamera/formats.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plumbline {
namespace {

namespace controls = libcamera::controls;
namespace formats = libcamera::formats;

// libcamera names RGB formats as DRM does, from the highest bits down: BGR888 has red first.
const std::array<std::pair<libcamera::PixelFormat, PixelFormat>, 29> kFormats = {{
    {formats::R8, PixelFormat::kGrey},
    {formats::YUYV, PixelFormat::kYuyv},
    {formats::NV12, PixelFormat::kNv12},
    {formats::MJPEG, PixelFormat::kMjpeg},
    {formats::BGR888, PixelFormat::kRgb24},
    {formats::SRGGB8, PixelFormat::kRggb8},
    {formats::SGRBG8, PixelFormat::kGrbg8},
    {formats::SGBRG8, PixelFormat::kGbrg8},
    {formats::SBGGR8, PixelFormat::kBggr8},
    {formats::SRGGB10, PixelFormat::kRggb10},
    {formats::SGRBG10, PixelFormat::kGrbg10},
    {formats::SGBRG10, PixelFormat::kGbrg10},
    {formats::SBGGR10, PixelFormat::kBggr10},
    {formats::SRGGB10_CSI2P, PixelFormat::kRggb10Packed},
    {formats::SGRBG10_CSI2P, PixelFormat::kGrbg10Packed},
    {formats::SGBRG10_CSI2P, PixelFormat::kGbrg10Packed},
    {formats::SBGGR10_CSI2P, PixelFormat::kBggr10Packed},
    {formats::SRGGB12, PixelFormat::kRggb12},
    {formats::SGRBG12, PixelFormat::kGrbg12},
    {formats::SGBRG12, PixelFormat::kGbrg12},
    {formats::SBGGR12, PixelFormat::kBggr12},
    {formats::SRGGB12_CSI2P, PixelFormat::kRggb12Packed},
    {formats::SGRBG12_CSI2P, PixelFormat::kGrbg12Packed},
    {formats::SGBRG12_CSI2P, PixelFormat::kGbrg12Packed},
    {formats::SBGGR12_CSI2P, PixelFormat::kBggr12Packed},
    {formats::SRGGB16, PixelFormat::kRggb16},
    {formats::SGRBG16, PixelFormat::kGrbg16},
    {formats::SGBRG16, PixelFormat::kGbrg16},
    {formats::SBGGR16, PixelFormat::kBggr16},
}};

template <typename T>
bool offers(const libcamera::ControlInfoMap& offered, const libcamera::Control<T>& control) {
  return compat::offered(offered, control) != nullptr;
}

void show_whole_sensor(const libcamera::ControlInfoMap& offered, libcamera::ControlList& list) {
  if (!offers(offered, controls::ScalerCrop)) return;
  const libcamera::ControlValue& whole = compat::offered(offered, controls::ScalerCrop)->max();
  if (whole.type() == libcamera::ControlTypeRectangle) {
    list.set(controls::ScalerCrop, whole.get<libcamera::Rectangle>());
  }
}

void lock_focus(const libcamera::ControlInfoMap& offered, const CameraOptions& options,
                std::optional<double> lens_position, LibcameraSettings& settings) {
  if (offers(offered, controls::AfMode)) {
    settings.controls.set(controls::AfMode, controls::AfModeManual);
  }
  const std::optional<double> wanted =
      options.lens_position_dioptre ? options.lens_position_dioptre : lens_position;
  if (!wanted) return;
  if (offers(offered, controls::LensPosition)) {
    settings.controls.set(controls::LensPosition, static_cast<float>(*wanted));
  } else if (options.lens_position_dioptre) {
    settings.notices.push_back("The camera cannot set its focus; it stays as the lens is.");
  }
}

void set_rate(const libcamera::ControlInfoMap& offered, const CameraOptions& options,
              LibcameraSettings& settings) {
  if (!options.frames_per_s || *options.frames_per_s <= 0) return;
  if (!offers(offered, controls::FrameDurationLimits)) {
    settings.notices.push_back("The camera chooses its frame rate itself.");
    return;
  }
  const auto us = static_cast<std::int64_t>(std::llround(1e6 / *options.frames_per_s));
  settings.controls.set(controls::FrameDurationLimits, {us, us});
}

double number(const libcamera::ControlValue& value) {
  switch (value.type()) {
    case libcamera::ControlTypeBool:
      return value.get<bool>() ? 1 : 0;
    case libcamera::ControlTypeByte:
      return value.get<std::uint8_t>();
    case libcamera::ControlTypeInteger32:
      return value.get<std::int32_t>();
    case libcamera::ControlTypeInteger64:
      return static_cast<double>(value.get<std::int64_t>());
    case libcamera::ControlTypeFloat:
      return static_cast<double>(value.get<float>());
    default:
      return std::nan("");
  }
}

}  // namespace

std::optional<PixelFormat> pixel_format_of(const libcamera::PixelFormat& format) {
  for (const auto& [theirs, ours] : kFormats) {
    if (theirs == format) return ours;
  }
  return std::nullopt;
}

std::vector<CameraMode> modes_of(const libcamera::CameraConfiguration& configuration) {
  std::vector<CameraMode> modes;
  if (configuration.empty()) return modes;
  const libcamera::StreamFormats& offered = configuration.at(0).formats();
  for (const libcamera::PixelFormat& theirs : offered.pixelformats()) {
    const std::optional<PixelFormat> format = pixel_format_of(theirs);
    if (!format) continue;
    for (const libcamera::Size& size : offered.sizes(theirs)) {
      modes.push_back(
          {static_cast<int>(size.width), static_cast<int>(size.height), *format, std::nullopt});
    }
  }
  return modes;
}

std::vector<CameraMode> modes_of(libcamera::Camera& camera) {
  std::vector<CameraMode> modes;
  for (const auto role : {libcamera::StreamRole::StillCapture, libcamera::StreamRole::Raw}) {
    const auto configuration = compat::configuration_for(camera, role);
    if (!configuration) continue;
    for (const CameraMode& mode : modes_of(*configuration)) {
      const bool known = std::any_of(modes.begin(), modes.end(), [&](const CameraMode& other) {
        return other.width_px == mode.width_px && other.height_px == mode.height_px &&
               other.format == mode.format;
      });
      if (!known) modes.push_back(mode);
    }
  }
  return modes;
}

std::unique_ptr<libcamera::CameraConfiguration> configuration_for(libcamera::Camera& camera,
                                                                  const CameraOptions& options) {
  const bool raw = options.raw || (options.format && bayer_of(*options.format));
  if (raw) {
    auto configuration = compat::configuration_for(camera, libcamera::StreamRole::Raw);
    if (configuration && !modes_of(*configuration).empty()) return configuration;
  }
  return compat::configuration_for(camera, libcamera::StreamRole::StillCapture);
}

bool set_exposure(const libcamera::ControlInfoMap& offered, const CameraOptions& options,
                  libcamera::ControlList& list) {
  if (!offers(offered, controls::ExposureTime)) return true;
  const bool both = options.fixed_gain.has_value() || options.fixed_exposure;
  const bool exposure_only = !both && compat::hold_exposure_only(offered, list);
  if (!exposure_only && offers(offered, controls::AeEnable)) list.set(controls::AeEnable, false);
  const libcamera::ControlInfo& info = *compat::offered(offered, controls::ExposureTime);
  const double shortest = std::max(number(info.min()), 1.0);
  const double longest = number(info.max());
  const double us =
      std::max(shortest, std::min(static_cast<double>(options.longest_exposure.count()),
                                  longest > shortest ? longest : 1e9));
  list.set(controls::ExposureTime, static_cast<std::int32_t>(us));
  if (options.fixed_gain && offers(offered, controls::AnalogueGain)) {
    list.set(controls::AnalogueGain, static_cast<float>(*options.fixed_gain));
  }
  return both || exposure_only;
}

LibcameraSettings settings_for(const libcamera::Camera& camera, const CameraOptions& options,
                               std::optional<double> lens_position) {
  LibcameraSettings settings;
  const libcamera::ControlInfoMap& offered = camera.controls();
  show_whole_sensor(offered, settings.controls);
  compat::turn_off_hdr(offered, settings.controls);
  lock_focus(offered, options, lens_position, settings);
  set_rate(offered, options, settings);
  if (!set_exposure(offered, options, settings.controls)) {
    settings.notices.push_back(
        "The camera cannot suit its gain to the light while its exposure is limited: brightness "
        "is as the exposure makes it.");
  }
  if (!offers(offered, controls::ExposureTime)) {
    settings.notices.push_back(
        "The camera cannot limit its exposure: photos may blur, and their time is less certain.");
  }
  if (options.fixed_gain && !offers(offered, controls::AnalogueGain)) {
    settings.notices.push_back("The camera cannot set its gain; it may vary.");
  }
  return settings;
}

std::vector<CameraControl> describe_controls(const libcamera::ControlInfoMap& offered) {
  std::vector<CameraControl> described;
  for (const auto& [id, info] : offered) {
    const double minimum = number(info.min());
    if (std::isnan(minimum)) continue;
    const double usual = number(info.def());
    described.push_back(
        {id->name(), minimum, number(info.max()), std::isnan(usual) ? minimum : usual});
  }
  std::sort(described.begin(), described.end(),
            [](const CameraControl& a, const CameraControl& b) { return a.name < b.name; });
  return described;
}

std::string model_of(const libcamera::Camera& camera) {
  const auto model = camera.properties().get(libcamera::properties::Model);
  return model ? std::string(*model) : camera.id();  // a view since 0.5
}

}  // namespace plumbline
