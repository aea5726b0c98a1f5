// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <memory>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "drivers/camera/v4l2_camera.h"
#include "drivers/posix/system_clock.h"
#include "edge/pixels/pixels.h"

namespace plumbline::contract {
namespace {

constexpr int kWidth = 640;
constexpr int kHeight = 360;
constexpr int kBars = 8;  // the kernel's test picture: eight upright bars of colour

using Bars = std::array<std::array<double, 3>, kBars>;

// The mean colour inside of each bar, in the lower half, where no text is written.
Bars bars_of(const Image& rgb) {
  Bars bars{};
  constexpr int kSide = 20;
  for (int bar = 0; bar < kBars; ++bar) {
    const int left = bar * kWidth / kBars + (kWidth / kBars - kSide) / 2;
    for (int v = 300; v < 300 + kSide; ++v) {
      for (int u = left; u < left + kSide; ++u) {
        for (std::size_t c = 0; c < 3; ++c) {
          bars[static_cast<std::size_t>(bar)][c] +=
              static_cast<double>(rgb.data[rgb.index(u, v) + c]) / (kSide * kSide);
        }
      }
    }
  }
  return bars;
}

// The first frame in a format, as colours; or why there is none.
Result<Image> shown_in(const std::string& path, PixelFormat format) {
  posix::SystemClock clock;
  V4l2Camera camera(path, clock);
  CameraOptions options;
  options.width_px = kWidth;
  options.height_px = kHeight;
  options.format = format;
  std::mutex mutex;
  std::shared_ptr<const RawImage> first;
  const Status started = camera.start(options, [&](CameraEvent event) {
    const std::lock_guard lock(mutex);
    const auto* frame = std::get_if<Frame>(&event);
    if (frame != nullptr && !first) first = frame->image;
  });
  if (!started) return started.error();
  for (int i = 0; i < 1000; ++i) {
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    const std::lock_guard lock(mutex);
    if (first) break;
  }
  camera.stop();
  return first ? pixels::rgb_of(*first) : Error{"No frame came in 10 s."};
}

// A flat bar loses nothing by demosaicing; the kernel and we round each sample once.
constexpr double kRounding = 2;

std::vector<PixelFormat> bayer_formats_of(const CameraDescription& camera) {
  std::vector<PixelFormat> formats;
  for (const CameraMode& mode : camera.modes) {
    const bool known = std::find(formats.begin(), formats.end(), mode.format) != formats.end();
    if (!known && bayer_of(mode.format)) formats.push_back(mode.format);
  }
  return formats;
}

TEST(CameraFormats, ShowInEveryBayerFormatThePictureThatRgbShows) {
  const char* path = std::getenv("PLUMBLINE_TEST_CAMERA");
  if (path == nullptr || std::string(path).rfind("/dev/video", 0) != 0) {
    GTEST_SKIP() << "PLUMBLINE_TEST_CAMERA names no video device: none is looked at";
  }
  const auto reference = shown_in(path, PixelFormat::kRgb24);
  ASSERT_TRUE(reference) << reference.error().sentence;
  const Bars expected = bars_of(*reference);
  EXPECT_GT(expected[0][0] - expected[7][0], 100) << "white to black";
  const auto described = describe_v4l2(path);
  ASSERT_TRUE(described) << described.error().sentence;
  const std::vector<PixelFormat> formats = bayer_formats_of(*described);
  EXPECT_GE(formats.size(), 16u) << "the kernel's test camera has 8, 10, 12 and 16 bits";
  for (const PixelFormat format : formats) {
    const auto rgb = shown_in(path, format);
    ASSERT_TRUE(rgb) << name_of(format) << ": " << rgb.error().sentence;
    const Bars shown = bars_of(*rgb);
    for (std::size_t bar = 0; bar < kBars; ++bar) {
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(shown[bar][c], expected[bar][c], kRounding)
            << name_of(format) << ", bar " << bar << ", channel " << c;
      }
    }
  }
}

}  // namespace
}  // namespace plumbline::contract
