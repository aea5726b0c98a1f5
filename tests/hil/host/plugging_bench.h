// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <random>
#include <string>

#include "edge/base/result.h"
#include "tests/hil/host/companion.h"
#include "tests/hil/host/drone.h"
#include "tests/hil/host/timeline.h"

namespace plumbline::hil {

struct PluggingOptions {
  std::string sockets;    // the folder of hil_start_system
  std::string work;       // where the timeline is written
  std::string cut_power;  // a command that takes the machine's power and starts it again
  std::uint64_t seed = 1;
  std::chrono::seconds up_within{300};
  std::chrono::seconds ready_within{30};       // of the last plug
  std::chrono::seconds boot_ready_within{90};  // of power or the last plug
};

// Receiver and camera plugged into the virtual computer in each order at random times, while it
// boots and while it runs: the daemon is ready when both are there, and not before.
class PluggingBench {
 public:
  PluggingBench(const sim::BenchFlight& flight, const DroneOptions& drone, PluggingOptions options);

  // Through all of them, also when some fail: how many did.
  Result<int> run();

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;
  struct Round {
    const char* what;
    bool at_boot;
    bool pulls_receiver, pulls_camera;
    bool receiver_first;
  };

  Status play(const Round& round);
  Status pull(const Round& round);
  Status plug(const Round& round);
  double drawn(double most_s) { return std::uniform_real_distribution<double>(0, most_s)(random_); }

  const sim::BenchFlight& flight_;
  DroneOptions drone_options_;
  PluggingOptions options_;
  std::mt19937_64 random_;
  Timeline timeline_;
  Companion companion_;
  Drone drone_;
};

}  // namespace plumbline::hil
