// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <cstdint>
#include <optional>
#include <variant>

#include "edge/base/gnss_fix.h"
#include "edge/base/time.h"

namespace plumbline::capture {

enum class Phase {
  kWaiting,  // for a position, or for the camera
  kReady,    // on the ground
  kFlying,
  kLanded  // the flight is over; a new run begins
};

enum class Reason { kTest, kHeight, kAside, kTime, kDistance, kBlind };

// What a photo is for. `entry` counts the heights of the plan (HeightSteps); -1 for other reasons.
struct Target {
  Reason reason = Reason::kHeight;
  int entry = -1;
  double height_m = 0;  // above the take-off point; of kHeight
};

// What whoever works with the photo has to know.
struct Marks {
  bool late = false;         // its height had gone by
  bool reckoned = false;     // where from the last climb rate: no position of late
  bool no_position = false;  // not even that
  bool not_fixed = false;    // position, but not a fixed one
  bool still = false;        // taken at rest
  bool jumped = false;       // the position had jumped, and not come back: it may be wrong
  bool resumed = false;      // in a flight that was interrupted
};

// What was known of the antenna when the photo was decided, at the instant of exposure.
struct Place {
  Eigen::Vector3d in_enu_m = Eigen::Vector3d::Zero();  // about the first position of the run
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  double height_m = 0;  // above the take-off point
  FixQuality quality = FixQuality::kNone;
  std::chrono::nanoseconds age{};  // of the newest fix
};

// The trigger line is to be pulsed, at once.
struct Pulse {
  int number = 0;  // of the photo; 0: a test
};

// A photo was taken: which frame is it, and what for.
struct PhotoTaken {
  int number = 0;
  Target target;
  std::optional<std::uint64_t> frame;  // its sequence; empty where the camera keeps its photos
  HostTime wanted;                     // the instant aimed at
  HostTime exposed;                    // middle of the exposure
  std::chrono::nanoseconds exposed_sigma{};
  std::optional<Place> place;
  Marks marks;
};

// Decided, and then no exposure came, or the photo was lost. Its target is open again.
struct PhotoMissed {
  int number = 0;
  Target target;
  HostTime wanted;
};

struct PhaseChanged {
  Phase phase = Phase::kWaiting;
  std::optional<double> ground_height_m;  // ellipsoidal, of the take-off point
};

// Where a flight began without a position, or on the ground still: its take-off point, as it is
// known from here on.
struct GroundFound {
  double ground_height_m = 0;  // ellipsoidal
};

// The drone has left a height of the plan behind without a photo. It is taken when the drone comes
// by again.
struct HeightPassed {
  Target target;
};

using Decided =
    std::variant<Pulse, PhotoTaken, PhotoMissed, PhaseChanged, GroundFound, HeightPassed>;

struct Decision {
  HostTime time;
  Decided what;
};

}  // namespace plumbline::capture
