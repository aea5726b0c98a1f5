// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <set>
#include <string>
#include <utility>

#include "drivers/storage.h"
#include "firmware/flight/session.h"
#include "tests/firmware/flight/recorded_flight.h"
#include "tests/flights/drone.h"

namespace plumbline::flight {

// A small flight that is interrupted: its program ends at some moment, while the drone flies on,
// and is started again. Whatever happens, what was reported as stored is there, and the flight goes
// on by itself.
class InterruptedFlight {
 public:
  InterruptedFlight();

  flights::Drone& drone() { return drone_; }
  static SessionOptions plan();  // three heights, and a side-step
  Devices devices(Storage& disk) {
    return {drone_.clock(), disk, drone_.receiver(), &drone_.camera()};
  }

  // A photo was reported; not twice.
  void reported(const std::string& folder, int number);

  // What the program had left behind, `off` before it is started again, and all that follows.
  void go_on(Storage& disk, std::chrono::nanoseconds off);

 private:
  void everything_reported_is_there(Storage& disk) const;
  void goes_on_by_itself(Storage& disk);
  void check(Storage& disk, const RecordedFlight& flight);
  void check_place(const capture::PhotoTaken& taken);
  bool could_be_taken(double height_m);
  void check_heights(Storage& disk);

  flights::Drone drone_;
  bool knows_ground_ = false;  // else it is switched on for the first time in the air, or before
  HostTime back_;
  std::set<std::pair<std::string, int>> reported_;
};

}  // namespace plumbline::flight
