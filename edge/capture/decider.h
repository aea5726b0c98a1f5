// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "edge/base/ring.h"
#include "edge/capture/aim.h"
#include "edge/capture/capture_plan.h"
#include "edge/capture/decisions.h"
#include "edge/capture/height_steps.h"
#include "edge/capture/inputs.h"
#include "edge/capture/navigator.h"
#include "edge/capture/release.h"
#include "edge/capture/stillness.h"
#include "edge/capture/take_off.h"

namespace plumbline::capture {

// Decides when a flight begins, when to take which photo, and when the flight is over. A function
// of its options and inputs alone: no clock, no device, no thread. One run is one flight, from the
// ground to the ground.
class Decider {
 public:
  explicit Decider(const CaptureOptions& options);

  // Appends what follows from `input` to `decisions`.
  void take(const Input& input, std::vector<Decision>& decisions);

  // When a Tick is wanted at the latest; max: never.
  HostTime due() const;

  // Whether a frame's pixels may still be asked for.
  bool holds(std::uint64_t sequence) const;

  Phase phase() const { return phase_; }
  const HeightSteps& steps() const { return steps_; }
  const Navigator& navigator() const { return navigator_; }
  std::optional<double> ground_height_m() const { return take_off_.ground_height_m(); }

 private:
  static constexpr std::size_t kMostUnderWay = 64;  // to the disk

  bool by_pulse() const { return options_.release.release == Release::kPulse; }
  void hear(HostTime now, const Happening& what, std::vector<Decision>& decisions);
  void hear_fix(HostTime now, const FixHeard& heard);
  void hear_frame(const FrameSeen& frame, std::vector<Decision>& decisions);
  void resume(const Resumed& resumed);
  void hear_lost(const PhotoLost& lost, std::vector<Decision>& decisions);
  void look_at_ground();
  void follow_ground(std::vector<Decision>& decisions);
  void look_at_heights(HostTime time, std::vector<Decision>& decisions);
  void look_at_phase(std::vector<Decision>& decisions);
  void change_phase(Phase phase, std::vector<Decision>& decisions);
  void work(std::vector<Decision>& decisions);
  void test(std::vector<Decision>& decisions);
  void re_aim(std::vector<Decision>& decisions);
  std::optional<Aim> just_gone_by(HostTime earliest) const;
  void pulse_if_due(std::vector<Decision>& decisions);
  void close(const Exposure& exposure, std::vector<Decision>& decisions);
  void miss(std::vector<Decision>& decisions);
  std::optional<Place> place_at(HostTime time) const;
  Marks marks_of(const std::optional<Place>& place) const;

  CaptureOptions options_;
  Navigator navigator_;
  TakeOffWatch take_off_;
  HeightSteps steps_;
  StillnessWatch stillness_;
  FrameRelease frames_;
  PulseRelease pulses_;

  HostTime now_;
  Phase phase_ = Phase::kWaiting;
  bool streaming_ = false;
  bool jumped_ = false;
  bool resumed_ = false;              // in the air
  bool ground_is_of_before_ = false;  // of a run before, and may be of another place
  bool ground_is_final_ = false;      // of this flight: it has left the ground
  std::optional<UtcTime> resumed_last_fix_;
  std::optional<HostTime> blind_from_;  // resumed in the air a moment ago: without position, too
  AimState aim_state_;
  std::optional<Aim> aim_;
  int last_number_ = 0;
  Ring<PhotoMissed> newest_{kMostUnderWay};  // photos taken, as they would be missed
  int tests_ = 0;
  HostTime next_test_;
  HostTime next_look_;
};

}  // namespace plumbline::capture
