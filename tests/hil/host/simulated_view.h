// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "edge/base/image.h"
#include "sim/flight.h"
#include "tests/hil/host/uvc_camera.h"

namespace plumbline::hil {

// What the camera sees while the drone climbs from 70 to 90 m over the simulated ground at 2 m/s,
// sinks again, and so on. Rendering takes longer than a frame may: pictures from every metre are
// made ahead in a thread, and a frame is the one of the nearest height, enlarged to its own by
// whole pixels. With half a metre of 80 in between, hills of 5 m are out of place by 0.1 px at the
// edges.
class SimulatedView {
 public:
  explicit SimulatedView(const UvcMode& mode);
  ~SimulatedView();

  std::string expose(const UvcExposure& exposure) const;

 private:
  void render_all();
  double height_m(std::chrono::steady_clock::time_point time) const;
  std::size_t nearest_picture(double height_m) const;

  sim::Profile profile_;
  sim::Flight flight_;
  std::vector<double> heights_m_;  // in the order in which they are rendered
  std::vector<Image> pictures_;    // grey; of those, the first `ready_`
  std::atomic<std::size_t> ready_{0};
  std::atomic<bool> stopping_{false};
  std::chrono::steady_clock::time_point begin_ = std::chrono::steady_clock::now();
  std::thread renderer_;
};

}  // namespace plumbline::hil
