// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "edge/base/result.h"
#include "sim/bench_flight.h"
#include "sim/gnss_stream.h"
#include "tests/hil/host/far_lines.h"
#include "tests/hil/host/flight_view.h"
#include "tests/hil/host/receiver_port.h"
#include "tests/hil/host/uvc_camera.h"

namespace plumbline::hil {

// The flight of the virtual companion computer: the same for all programs that speak of it.
struct DroneOptions {
  std::string profile = "standard";
  // Instead of the profile's: a climb without a side-step, to this height.
  std::optional<double> from_m, to_m;
  int width_px = 1600;  // of the camera; its height is that of the profile's
  int frames_per_s = 5;
  std::uint64_t seed = 1;
  // Released by the shutter line, and keeping its photos; with a pulse per second. Else the camera
  // runs freely on USB.
  bool by_pulse = false;
};
Result<sim::BenchFlight> flight_of(const DroneOptions& options);
UvcMode mode_of(const sim::BenchFlight& flight, const DroneOptions& options);
std::vector<double> heights_m_of(const DroneOptions& options);

// What is outside the companion computer: the drone that carries it, the receiver and the camera at
// the ends of its cables.
class Drone {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  // `flight` outlives it. Begins to make the camera's pictures; the drone stands on the ground.
  Drone(const sim::BenchFlight& flight, const DroneOptions& options);
  ~Drone() { leave(); }

  // Cables to a machine that has been started, whose sockets are in the folder. False where it
  // does not answer.
  bool board(const std::string& sockets);
  // When QEMU has ended.
  void leave();
  // The receiver's cable alone.
  bool plug_receiver(const std::string& sockets);
  void pull_receiver() { receiver_.reset(); }

  // What the camera on USB is going to see; null where there is none.
  const FlightView* view() const { return view_.get(); }
  UvcOrders& camera() { return camera_orders_; }
  const FarLines& lines() const { return lines_; }

  // Climbs soon; the flight's time 0.
  SteadyTime take_off();

  // Seconds of the flight; before it begins, below 0.
  double seconds(SteadyTime now) const;
  double height_m(SteadyTime now) const;

 private:
  sim::GnssStreamOptions receiver_options() const;

  const sim::BenchFlight& flight_;
  DroneOptions options_;
  UvcMode mode_;
  std::unique_ptr<FlightView> view_;
  UvcOrders camera_orders_;
  SteadyTime made_ = std::chrono::steady_clock::now();
  std::atomic<double> took_off_s_;  // after it was made
  std::shared_ptr<sim::GnssStream> stream_;
  std::unique_ptr<ReceiverPort> receiver_;
  FarLines lines_;
  RedirLink link_;
  std::thread camera_;
};

}  // namespace plumbline::hil
