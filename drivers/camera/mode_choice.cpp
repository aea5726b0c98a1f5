// SPDX-License-Identifier: MIT
#include "drivers/camera/mode_choice.h"

#include <algorithm>
#include <array>
#include <cstdint>
#include <tuple>

namespace plumbline {
namespace {

// At 3 m/s the nearest of 10 frames a second is off by 0.09 m; slower streams cost more than a
// better format brings.
constexpr double kEnoughFramesPerS = 10;
constexpr std::size_t kMostShown = 8;

constexpr std::array<PixelFormat, 8> kBestFirst = {
    PixelFormat::kNv12,  PixelFormat::kYuyv,         PixelFormat::kRgb24,  PixelFormat::kMjpeg,
    PixelFormat::kRggb8, PixelFormat::kRggb10Packed, PixelFormat::kRggb10, PixelFormat::kGrey};

int rank(PixelFormat format) {
  const auto* at = std::find(kBestFirst.begin(), kBestFirst.end(), format);
  return static_cast<int>(at - kBestFirst.begin());
}

std::int64_t pixels(const CameraMode& mode) {
  return static_cast<std::int64_t>(mode.width_px) * mode.height_px;
}

bool has_size(const CameraMode& mode, const CameraOptions& options) {
  return mode.width_px == options.width_px.value_or(mode.width_px) &&
         mode.height_px == options.height_px.value_or(mode.height_px);
}

bool may_be_cut_to(const CameraMode& mode, const CameraOptions& options) {
  return options.width_px && options.height_px && *options.width_px > 0 && *options.height_px > 0 &&
         *options.width_px <= mode.width_px && *options.height_px <= mode.height_px;
}

// Larger, then fast enough, then better, then faster.
auto merit(const CameraMode& mode, double wanted_per_s) {
  const double rate = mode.frames_per_s.value_or(wanted_per_s);
  const bool enough = rate > 0.95 * wanted_per_s;
  return std::tuple(pixels(mode), enough, enough ? 0.0 : rate, -rank(mode.format), rate);
}

std::string size_text(const CameraOptions& options) {
  std::string text;
  if (options.width_px || options.height_px) {
    text = (options.width_px ? std::to_string(*options.width_px) : "any") + " x " +
           (options.height_px ? std::to_string(*options.height_px) : "any");
  }
  if (options.format) text += (text.empty() ? "" : " ") + name_of(*options.format);
  return text;
}

std::vector<CameraMode> candidates(const std::vector<CameraMode>& modes,
                                   const CameraOptions& options) {
  std::vector<CameraMode> fitting;
  for (const CameraMode& mode : modes) {
    const bool format_fits = !options.format || *options.format == mode.format;
    if (format_fits && has_size(mode, options)) fitting.push_back(mode);
  }
  if (!fitting.empty()) return fitting;
  for (CameraMode mode : modes) {
    const bool format_fits = !options.format || *options.format == mode.format;
    if (!format_fits || !may_be_cut_to(mode, options)) continue;
    mode.width_px = *options.width_px;
    mode.height_px = *options.height_px;
    mode.frames_per_s.reset();
    fitting.push_back(mode);
  }
  return fitting;
}

}  // namespace

Result<CameraMode> choose_mode(const std::vector<CameraMode>& modes, const CameraOptions& options) {
  if (modes.empty()) {
    return Error{
        "The camera offers no pixel format that is read here (GREY, YUYV, NV12, MJPG, RGB3, "
        "RGGB, RG10, pRAA)."};
  }
  const std::vector<CameraMode> fitting = candidates(modes, options);
  if (fitting.empty()) {
    return Error{"The camera has no mode " + size_text(options) + "; it has " + text_of(modes) +
                 "."};
  }
  const double wanted = options.frames_per_s.value_or(kEnoughFramesPerS);
  return *std::max_element(fitting.begin(), fitting.end(),
                           [&](const CameraMode& a, const CameraMode& b) {
                             return merit(a, wanted) < merit(b, wanted);
                           });
}

std::string text_of(const std::vector<CameraMode>& modes) {
  std::vector<CameraMode> sorted = modes;
  std::stable_sort(sorted.begin(), sorted.end(),
                   [](const CameraMode& a, const CameraMode& b) { return pixels(a) > pixels(b); });
  std::string text;
  for (std::size_t i = 0; i < std::min(sorted.size(), kMostShown); ++i) {
    text += (i == 0 ? "" : ", ") + std::to_string(sorted[i].width_px) + " x " +
            std::to_string(sorted[i].height_px) + " " + name_of(sorted[i].format);
  }
  return sorted.size() > kMostShown ? text + " and others" : text;
}

}  // namespace plumbline
