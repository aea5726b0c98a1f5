// SPDX-License-Identifier: MIT
#pragma once

#include <optional>

#include "edge/base/time.h"
#include "edge/capture/capture_plan.h"
#include "edge/capture/ground.h"
#include "edge/capture/since.h"

namespace plumbline::capture {

// A height above where the vehicle was armed, as its autopilot has it.
struct PilotHeight {
  HostTime time;
  double above_arming_m = 0;
  double climb_m_s = 0;
};

// Tells the ground from the air, by the receiver's heights or by what the autopilot says, and finds
// the height of the ground. An autopilot that is not heard is replaced by the receiver. Pure.
class TakeOffWatch {
 public:
  explicit TakeOffWatch(const TakeOffOptions& options) : options_(options) {}

  // Each in order of time.
  void add(const HeightSeen& seen);
  void add(const PilotHeight& height);

  // The ground is known from before: the flight goes on.
  void resume(double ground_height_m) { ground_.set(ground_height_m); }

  // As the vehicle says; empty where it is not heard any more.
  void set_armed(std::optional<bool> armed) { armed_ = armed; }

  std::optional<double> ground_height_m() const { return ground_.height_m(); }
  // Of the newest height that the autopilot sent, where that is not of long ago.
  std::optional<double> above_arming_m(HostTime now) const;
  bool is_high() const { return above_.holds(); }  // as high as a take-off asks for, just now
  bool has_taken_off(HostTime now) const;          // of the ground; asked before the flight
  bool has_landed(HostTime now) const;             // asked in it

 private:
  bool asks_altitude(HostTime now) const;

  TakeOffOptions options_;
  Ground ground_;
  Since above_;  // the rise that is asked for
  Since low_;    // as low and still as after landing
  std::optional<PilotHeight> pilot_height_;
  Since pilot_above_;
  Since pilot_low_;
  std::optional<bool> armed_;
};

}  // namespace plumbline::capture
