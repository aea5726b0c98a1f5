// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <chrono>
#include <optional>
#include <variant>

#include "edge/base/time.h"

namespace plumbline {

// How urgent a text for the pilot is; the numbers are those of syslog, and of MAVLink.
enum class PilotSeverity {
  kEmergency = 0,
  kAlert = 1,
  kCritical = 2,
  kError = 3,
  kWarning = 4,
  kNotice = 5,
  kInfo = 6,
  kDebug = 7
};

// What an autopilot says of itself, as it says it. `arrival` is when the read returned that brought
// a message's last byte: later than the instant it speaks of, by an amount that is not said.

// Once a second.
struct PilotHeartbeat {
  HostTime arrival;
  bool armed = false;     // the motors may turn
  int system_id = 0;      // the vehicle's number, 1 to 255
  int autopilot = 0;      // MAV_AUTOPILOT: 3 ArduPilot, 12 PX4
  int vehicle_type = 0;   // MAV_TYPE: 2 quadrotor
  int system_status = 0;  // MAV_STATE: 3 standby, 4 active
};

// Of the airframe, not of a gimbal. Body axes forward, right, down; turned from north, east, down
// by yaw, then pitch, then roll. The angles are the autopilot's estimate, without a sigma: its yaw
// is that of a compass.
struct PilotAttitude {
  HostTime arrival;
  std::chrono::milliseconds time_boot{};  // on the autopilot's clock, since its start
  double roll_rad = 0;
  double pitch_rad = 0;
  double yaw_rad = 0;  // from north, clockwise
};

// The autopilot's filtered position, of its own receiver.
struct PilotPosition {
  HostTime arrival;
  std::chrono::milliseconds time_boot{};  // on the autopilot's clock, since its start
  std::optional<double> latitude_deg;     // both or neither: none before it has a position
  std::optional<double> longitude_deg;
  double altitude_msl_m = 0;
  double relative_altitude_m = 0;  // above where it was armed
  Eigen::Vector3d velocity_enu_m_s = Eigen::Vector3d::Zero();
  std::optional<double> heading_deg;  // of the nose, from north, clockwise, 0 to 360
};

using PilotMessage = std::variant<PilotHeartbeat, PilotAttitude, PilotPosition>;

}  // namespace plumbline
