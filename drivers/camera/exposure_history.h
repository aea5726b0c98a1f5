// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "edge/base/time.h"

namespace plumbline {

// How long frames were exposed, by what was set when, for cameras that do not say it of each frame.
// A new setting holds from an unknown one of the next frames on: sensors take two or three, and
// what is set with requests waits for those that are queued. Pure; one thread.
class ExposureHistory {
 public:
  // Frames after which a setting is taken to hold: five that are queued, and three.
  static constexpr int kSettlingFrames = 8;

  // `sigma` is half the range of what it may have been: the standard deviation of the two ends, and
  // more than that of anything between them.
  struct Exposure {
    std::chrono::nanoseconds mean{};
    std::chrono::nanoseconds sigma{};
  };

  // Set at `at`, read just before the device was told. The first is taken to hold from the start.
  void set(HostTime at, std::chrono::nanoseconds exposure);

  // Of a frame stamped `stamp`; frames are asked for in order, `period` apart. nullopt: nothing was
  // ever set.
  std::optional<Exposure> of_frame(HostTime stamp, std::chrono::nanoseconds period) const;

 private:
  struct Setting {
    HostTime at;
    std::chrono::nanoseconds exposure{};
  };

  std::vector<Setting> settings_;  // in order of time
};

}  // namespace plumbline
