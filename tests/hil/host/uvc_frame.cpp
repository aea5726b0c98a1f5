// SPDX-License-Identifier: MIT
#include "tests/hil/host/uvc_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include "tests/hil/host/exposure_mark.h"

namespace plumbline::hil {
namespace {

constexpr double kUsualExposureTimesGain = 20 * 10;

// Grey at every brightness, bounded by white.
std::array<char, 256> exposed(double brightness) {
  std::array<char, 256> table{};
  for (std::size_t grey = 0; grey < table.size(); ++grey) {
    const double level = std::min(255.0, std::round(brightness * static_cast<double>(grey)));
    table[grey] = static_cast<char>(static_cast<std::uint8_t>(level));
  }
  return table;
}

double brightness_of(const UvcSettings& set) {
  if (set.automatic) return 1;
  return static_cast<double>(set.exposure_100us * set.gain) / kUsualExposureTimesGain;
}

// Which column (or row) of a picture each of an enlarged one shows.
std::vector<std::size_t> shown(int count, double enlarged) {
  std::vector<std::size_t> indices;
  const double middle = 0.5 * (count - 1);
  for (int i = 0; i < count; ++i) {
    const double from = std::clamp(middle + (i - middle) / enlarged, 0.0, count - 1.0);
    indices.push_back(static_cast<std::size_t>(std::lround(from)));
  }
  return indices;
}

}  // namespace

Image grey_of(const Image& colour) {
  Image grey{colour.width_px, colour.height_px, 1, {}};
  grey.data.reserve(colour.data.size() / 3);
  for (std::size_t i = 0; i + 2 < colour.data.size(); i += 3) {
    const int luma = 299 * colour.data[i] + 587 * colour.data[i + 1] + 114 * colour.data[i + 2];
    grey.data.push_back(static_cast<std::uint8_t>(luma / 1000));
  }
  return grey;
}

std::string uvc_frame(const Image& grey, double enlarged, const UvcExposure& exposure) {
  const auto columns = shown(grey.width_px, enlarged);
  const std::array<char, 256> level = exposed(brightness_of(exposure.set));
  std::string bytes;
  bytes.reserve(2 * grey.data.size());
  for (const std::size_t row : shown(grey.height_px, enlarged)) {
    const std::uint8_t* line = &grey.data[row * static_cast<std::size_t>(grey.width_px)];
    for (const std::size_t column : columns) {
      bytes += level[line[column]];
      bytes += static_cast<char>(128);
    }
  }
  const std::chrono::nanoseconds middle = exposure.middle.time_since_epoch();
  write_exposure_mark(bytes, static_cast<std::uint64_t>(middle.count()));
  return bytes;
}

}  // namespace plumbline::hil
