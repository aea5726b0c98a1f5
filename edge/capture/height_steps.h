// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "edge/capture/capture_plan.h"

namespace plumbline::capture {

// The heights of a plan and what has become of each. With both directions each height is an entry
// twice: upwards (ascending), then downwards. An entry is taken once; bobbing about it changes
// nothing. One whose height has gone by is taken at once while near, else when the drone comes by
// again, in whatever direction. Heights are above the take-off point, metres.
class HeightSteps {
 public:
  struct Entry {
    double height_m = 0;
    int sign = 1;       // +1: upwards, -1: downwards
    bool open = false;  // downwards: only after the drone was above it
    bool passed = false;
    bool taken = false;
    bool told = false;  // that it was left behind
  };

  explicit HeightSteps(const CapturePlan& plan);

  // The drone is at this height now: what it has left behind is late from now on.
  void look(double height_m);

  // Entries still to take between two heights that the drone passes in this order; -1: none. The
  // one that is reached first.
  int first_between(double from_m, double to_m) const;

  // The one gone by that is near enough to be taken now; -1: none.
  int passed_at(double height_m) const;

  // The open one within `distance_m`; -1: none.
  int near(double height_m, double distance_m) const;

  // One gone by that is too far away to be taken from here, each but once and never `aimed_at`; -1:
  // none.
  int left_behind(double height_m, int aimed_at);

  void set_taken(int entry, bool taken);
  bool is_late(int entry, double height_m) const;  // gone by for more than a trifle
  const std::vector<Entry>& entries() const { return entries_; }
  std::vector<std::uint8_t> taken() const;
  void resume(const std::vector<std::uint8_t>& taken);
  bool any_taken() const;
  double lowest_m() const;

 private:
  bool is_wanted(const Entry& entry, int sign) const;
  double half_gap_m(std::size_t entry) const;

  std::vector<Entry> entries_;
};

}  // namespace plumbline::capture
