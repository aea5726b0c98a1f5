// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/camera.h"
#include "drivers/clock.h"
#include "drivers/trigger_line.h"
#include "edge/base/result.h"
#include "edge/capture/decisions.h"
#include "sim/bench_flight.h"
#include "sim/live_port.h"
#include "sim/paced_camera.h"

namespace plumbline {

struct BenchOptions {
  std::string folder;                // everything is in it; made where it is not there
  std::string profile = "standard";  // of the simulated flight: paper, standard or ice
  std::uint64_t seed = 1;
};

// A drone that is not there, for the daemon that is: in real time a receiver speaks on a
// pseudo-terminal, a camera sees the simulated ground below, and a wire releases it. The
// configuration that names them is a file in the folder, written where there is none, that a user
// may edit: with another camera, for one.
class SimulatedBench {
 public:
  static constexpr const char* kSimulated = "simulated";  // as id of a camera, as name of a line

  // Fails, with a sentence, where the folder cannot be used. `clock` outlives the bench.
  static Result<std::unique_ptr<SimulatedBench>> in(const BenchOptions& options, Clock& clock);

  std::string configuration() const { return folder_ + "/plumbline.toml"; }

  // The receiver can be opened. The flight has begun, on the ground, when the bench was made.
  Status start();

  std::unique_ptr<Camera> make_camera(bool released);
  std::unique_ptr<TriggerLine> make_release();  // of a camera that was made; outlived by it

  // What the daemon decided, and a flight that it ended: its truth is written beside it.
  void decided(const capture::Decision& decision);
  Status write_truth(const std::string& flight);

 private:
  SimulatedBench(const BenchOptions& options, Clock& clock, sim::BenchFlight flight);

  Status write_files();
  std::string configuration_text() const;
  double seconds_of(HostTime time) const { return in_seconds(time - begun_); }
  sim::LineSource receiver() const;
  double exposed_nearest(double seconds) const;

  std::string folder_;
  sim::Profile profile_;
  std::uint64_t seed_;
  Clock& clock_;
  sim::BenchFlight flight_;
  HostTime begun_;
  std::unique_ptr<sim::LivePort> port_;
  sim::PacedCamera* camera_ = nullptr;
  std::mutex mutex_;                 // of what follows
  std::vector<double> exposures_s_;  // of every picture, middles
  std::vector<sim::BenchFlight::Taken> taken_;
};

}  // namespace plumbline
