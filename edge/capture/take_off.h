// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "edge/base/time.h"
#include "edge/capture/capture_plan.h"
#include "edge/capture/ground.h"
#include "edge/capture/since.h"

namespace plumbline::capture {

// Tells the ground from the air. Pure.
class TakeOffWatch {
 public:
  explicit TakeOffWatch(const TakeOffOptions& options) : options_(options) {}

  // In order of time.
  void add(const HeightSeen& seen);

  // The ground is known from before: the flight goes on.
  void resume(double ground_height_m) { ground_.set(ground_height_m); }

  // As the vehicle says; used where the options say so.
  void set_armed(bool armed) { armed_ = armed; }

  std::optional<double> ground_height_m() const { return ground_.height_m(); }
  bool has_taken_off(HostTime now) const;  // of the ground; asked before the flight
  bool has_landed(HostTime now) const;     // asked in it

 private:
  TakeOffOptions options_;
  Ground ground_;
  Since above_;  // the rise that is asked for
  Since low_;    // as low and still as after landing
  std::optional<bool> armed_;
};

}  // namespace plumbline::capture
