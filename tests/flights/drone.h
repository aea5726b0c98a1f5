// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <memory>
#include <optional>
#include <utility>

#include "drivers/trigger_line.h"
#include "edge/geodesy/local_frame.h"
#include "firmware/flight/session.h"
#include "sim/climb_path.h"
#include "sim/gnss_stream.h"
#include "sim/replayed_receiver.h"
#include "sim/sim_camera.h"
#include "sim/virtual_clock.h"

namespace plumbline::flights {

struct DroneOptions {
  std::uint64_t seed = 1;
  sim::ClimbPathOptions path;
  sim::GnssStreamOptions receiver;
  sim::SimCameraOptions camera;
  // The receiver's cable is out between two times of the host.
  std::optional<std::pair<HostTime, HostTime>> cable_out;
  HostTime
      switched_on;  // the receiver's stream and the path are of the whole world, which is older
};

// A simulated drone around a companion computer: the world goes on when the computer is restarted.
class Drone {
 public:
  explicit Drone(const DroneOptions& options);

  sim::VirtualClock& clock() { return clock_; }
  GnssReceiver& receiver() { return receiver_; }
  sim::SimCamera& camera() { return camera_; }
  const sim::ClimbPath& path() const { return path_; }

  // Where the antenna truly is, about the take-off point.
  Eigen::Vector3d place_m(HostTime time) const;
  HostTime end() const;

 private:
  std::optional<sim::LinePiece> next_piece();

  sim::ClimbPath path_;
  geodesy::LocalFrame frame_;
  sim::VirtualClock clock_;
  double rate_error_;
  sim::GnssStream stream_;
  std::deque<sim::LinePiece> cable_;     // what is still to happen to it
  std::optional<sim::LinePiece> piece_;  // that comes after that
  sim::ReplayedReceiver receiver_;
  sim::SimCamera camera_;
};

}  // namespace plumbline::flights
