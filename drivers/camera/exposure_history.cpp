// SPDX-License-Identifier: MIT
#include "drivers/camera/exposure_history.h"

#include <algorithm>
#include <cstddef>

namespace plumbline {
namespace {

// A new limit comes a few times a second at most, and settles in less than that.
constexpr std::size_t kMostSettings = 64;

}  // namespace

void ExposureHistory::set(HostTime at, std::chrono::nanoseconds exposure) {
  if (!settings_.empty() && settings_.back().exposure == exposure) return;
  if (settings_.size() == kMostSettings) settings_.erase(settings_.begin());
  settings_.push_back({at, exposure});
}

std::optional<ExposureHistory::Exposure> ExposureHistory::of_frame(
    HostTime stamp, std::chrono::nanoseconds period) const {
  if (settings_.empty()) return std::nullopt;
  auto shortest = settings_.front().exposure;
  auto longest = shortest;
  for (const Setting& setting : settings_) {
    if (setting.at > stamp) break;
    if (stamp - setting.at >= kSettlingFrames * period) shortest = longest = setting.exposure;
    shortest = std::min(shortest, setting.exposure);
    longest = std::max(longest, setting.exposure);
  }
  return Exposure{(shortest + longest) / 2, (longest - shortest) / 2};
}

}  // namespace plumbline
