// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstddef>
#include <optional>
#include <vector>

#include "edge/base/time.h"

namespace plumbline::gnss_driver {

// Finds the speed of a serial line: tries one after the other until sentences come, and stays with
// the one at which they came. Bytes that come at another speed look like noise.
class SpeedSearch {
 public:
  // The first of `speeds` is tried first; with fewer than two there is nothing to search.
  explicit SpeedSearch(std::vector<int> speeds) : speeds_(std::move(speeds)) {}

  void begin(HostTime now);  // at the speed at hand
  void bytes_came(std::size_t count) { bytes_ += count; }
  void sentence_came(HostTime now);

  // The next speed to set, when the one at hand is not it.
  std::optional<int> next(HostTime now);

 private:
  bool is_wrong(HostTime now) const;

  std::vector<int> speeds_;
  std::size_t at_ = 0;
  bool proved_ = false;  // sentences came at the speed at hand
  HostTime since_;       // the speed was set, or the last sentence came
  std::size_t bytes_ = 0;
};

}  // namespace plumbline::gnss_driver
