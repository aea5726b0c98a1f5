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

constexpr std::array<PixelFormat, 4> kFinishedBestFirst = {
    PixelFormat::kNv12, PixelFormat::kYuyv, PixelFormat::kRgb24, PixelFormat::kMjpeg};

// Of Bayer only the upper 8 bits are used for a picture: fewer bytes are better.
int bits_in_memory(const BayerLayout& bayer) {
  if (bayer.packed) return bayer.bits;
  return bayer.bits == 8 ? 8 : 16;
}

// The lowest is best. Of Bayer after all that is finished, 8 to 16; then grey.
int rank(PixelFormat format) {
  if (const auto bayer = bayer_of(format)) return bits_in_memory(*bayer);
  if (format == PixelFormat::kGrey) return 17;
  const auto* at = std::find(kFinishedBestFirst.begin(), kFinishedBestFirst.end(), format);
  return static_cast<int>(at - kFinishedBestFirst.begin());
}

// Of a raw file every bit counts, and then the bytes.
int raw_rank(PixelFormat format) {
  const BayerLayout bayer = bayer_of(format).value_or(BayerLayout{});
  return bits_in_memory(bayer) - 100 * bayer.bits;
}

std::int64_t pixels(const CameraMode& mode) {
  return static_cast<std::int64_t>(mode.width_px) * mode.height_px;
}

bool has_size(const CameraMode& mode, const CameraOptions& options) {
  return mode.width_px == options.width_px.value_or(mode.width_px) &&
         mode.height_px == options.height_px.value_or(mode.height_px);
}

bool has_format(const CameraMode& mode, const CameraOptions& options) {
  if (options.raw && !bayer_of(mode.format)) return false;
  return !options.format || *options.format == mode.format;
}

bool may_be_cut_to(const CameraMode& mode, const CameraOptions& options) {
  return options.width_px && options.height_px && *options.width_px > 0 && *options.height_px > 0 &&
         *options.width_px <= mode.width_px && *options.height_px <= mode.height_px;
}

// Larger, then fast enough, then better, then faster.
auto merit(const CameraMode& mode, double wanted_per_s, bool raw) {
  const int format_rank = raw ? raw_rank(mode.format) : rank(mode.format);
  const double rate = mode.frames_per_s.value_or(wanted_per_s);
  const bool enough = rate > 0.95 * wanted_per_s;
  return std::tuple(pixels(mode), enough, enough ? 0.0 : rate, -format_rank, rate);
}

std::string size_text(const CameraOptions& options) {
  std::string text;
  if (options.width_px || options.height_px) {
    text = (options.width_px ? std::to_string(*options.width_px) : "any") + " x " +
           (options.height_px ? std::to_string(*options.height_px) : "any");
  }
  if (options.format) text += (text.empty() ? "" : " ") + name_of(*options.format);
  if (options.raw && !options.format) text += text.empty() ? "of raw frames" : " of raw frames";
  return text;
}

std::vector<CameraMode> candidates(const std::vector<CameraMode>& modes,
                                   const CameraOptions& options) {
  std::vector<CameraMode> fitting;
  for (const CameraMode& mode : modes) {
    if (has_format(mode, options) && has_size(mode, options)) fitting.push_back(mode);
  }
  if (!fitting.empty()) return fitting;
  for (CameraMode mode : modes) {
    if (!has_format(mode, options) || !may_be_cut_to(mode, options)) continue;
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
    return Error{"The camera offers no pixel format that is read here (" + pixel_format_names() +
                 ")."};
  }
  const std::vector<CameraMode> fitting = candidates(modes, options);
  if (fitting.empty()) {
    return Error{"The camera has no mode " + size_text(options) + "; it has " + text_of(modes) +
                 "."};
  }
  const double wanted = options.frames_per_s.value_or(options.raw ? 0 : kEnoughFramesPerS);
  return *std::max_element(fitting.begin(), fitting.end(),
                           [&](const CameraMode& a, const CameraMode& b) {
                             return merit(a, wanted, options.raw) < merit(b, wanted, options.raw);
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
