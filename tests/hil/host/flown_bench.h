// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "tests/hil/host/companion.h"
#include "tests/hil/host/drone.h"
#include "tests/hil/host/timeline.h"

namespace plumbline::hil {

// What is done to a flight, once or several times, from the first time that the drone is so high,
// or from so many seconds after the flight's beginning.
struct Fault {
  std::string name;
  double from_height_m = 55;
  std::optional<double> from_s;
  double lasts_s = 6;
  int times = 1;
  double apart_s = 0;  // from the end of one to the beginning of the next
};
// "cable" (of the receiver, pulled ten times), "camera", "stall", "disk", "power"; "cable@40":
// once, at 40 m; "cable@40s": once, after 40 s. Empty for any other text.
std::optional<Fault> fault_of(const std::string& text);

struct FlownOptions {
  std::string sockets;  // the folder of hil_start_system
  std::string work;     // where the timeline and the flight's beginning are written
  std::vector<Fault> faults;
  std::string cut_power;  // a command that takes the machine's power and starts it again
  std::chrono::seconds ready_within{300};
};

struct Flown {
  std::string flight;  // its folder's name
  int photos_stored = 0;
  int stored_at_cut = 0;            // photos of which the daemon had said so when its power went
  std::int64_t begun_ns = 0;        // the flight's time 0, by the clock of the exposure marks
  std::vector<double> exposures_s;  // since then, of a camera that is released by pulses
};

// A flight of the installed program in the virtual computer that has been started: configures it as
// its user would, waits until it is ready, takes off, does what is to be done to it, and lands.
class FlownBench {
 public:
  FlownBench(const sim::BenchFlight& flight, const DroneOptions& drone, FlownOptions options);

  Result<Flown> fly();

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;
  using Json = nlohmann::json;

  Status board();
  Status configure();
  Status take_off();
  Status land();
  struct Doing {
    Fault fault;
    bool reached = false;  // its height, or time
    int begun = 0;         // so many times
    bool is_on = false;
    SteadyTime next{};  // its beginning, or the end of one that is on
  };
  void do_faults();
  bool reaches(const Fault& fault, SteadyTime now) const;
  void do_fault(Doing& doing);
  Status begin_fault(const std::string& name);
  Status end_fault(const std::string& name);
  Status cut_power();

  const sim::BenchFlight& flight_;
  DroneOptions drone_options_;
  FlownOptions options_;
  Timeline timeline_;
  Companion companion_;
  Drone drone_;
  std::string under_way_;      // the folder of the flight, as the daemon last said
  std::string cut_on_ground_;  // that of a flight whose power went when it had come down again
  Flown flown_;
  std::vector<Doing> doings_;
};

}  // namespace plumbline::hil
