// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <map>
#include <string>
#include <thread>
#include <vector>

#include "sim/bench_flight.h"
#include "tests/hil/host/uvc_camera.h"

namespace plumbline::hil {

// Of the moments of a camera whose first is the flight's beginning, those whose pictures are made
// ahead: near each height of the plan while it climbs, and all of the way aside. Ascending.
std::vector<int> moments_to_show(const sim::BenchFlight& flight,
                                 const std::vector<double>& heights_m, const UvcMode& mode);

// What a camera sees in a flight. Rendering takes longer than a frame may: moments_to_show() are
// made ahead in a thread; any other frame shows the
// nearest of those, enlarged by whole pixels, as a person would want it and no measurement may.
class FlightView {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  // `flight` outlives it.
  FlightView(const sim::BenchFlight& flight, const std::vector<double>& heights_m,
             const UvcMode& mode);
  ~FlightView();

  int pictures() const { return static_cast<int>(moments_.size()); }
  int made() const { return made_; }

  // The flight's time 0, one of the camera's moments. Until then it stands on the ground.
  void begin(SteadyTime at) { begun_ns_ = at.time_since_epoch().count(); }

  // From the camera's thread.
  std::string expose(const UvcExposure& exposure) const;

 private:
  void make_all();

  const sim::BenchFlight& flight_;
  UvcMode mode_;
  Image ground_;
  std::vector<int> moments_;     // intervals since the flight's beginning, ascending
  std::vector<Image> pictures_;  // of each; the first `made_`
  std::atomic<int> made_{0};
  std::atomic<bool> stopping_{false};
  std::atomic<std::int64_t> begun_ns_{0};  // 0: not yet
  std::thread maker_;
};

}  // namespace plumbline::hil
