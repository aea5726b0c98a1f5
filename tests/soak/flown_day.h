// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "edge/geodesy/local_frame.h"
#include "firmware/service/daemon.h"
#include "sim/climb_path.h"
#include "sim/gnss_stream.h"
#include "sim/sim_camera.h"
#include "sim/sim_disk.h"
#include "sim/sim_receiver.h"
#include "sim/virtual_clock.h"
#include "tests/soak/in_use.h"
#include "tests/soak/scripted_pilot.h"

namespace plumbline::soak {

constexpr int kFlightsAnHour = 20;  // one each 90 s; then half an hour on the ground

// A flight that has landed.
struct Flown {
  std::string folder;
  std::vector<double> heights_m;  // photographed
  int aside = 0;                  // photos
  bool operator==(const Flown&) const = default;
};

// What one hour left behind, before somebody took the flights away; and what the process held
// after that.
struct FlownHour {
  std::vector<Flown> flights;
  int stored = 0;  // photos
  std::uint64_t disk_bytes = 0;
  std::size_t folders = 0;  // of flights, and one that is open
  InUse in_use;
};

// A daemon that stays on for a day: armed, flown, landed, disarmed, twenty times an hour, with an
// autopilot, a receiver, a camera and a disk that have their troubles. Everything is on the virtual
// clock but the threads that give advice and show the status.
class FlownDay {
 public:
  // `folder` is a real one: for the status, and for the lock of the recordings.
  FlownDay(int hours, const std::string& folder);

  // Lives through it; `done` is told of each hour, and keeps nothing. Fails where the daemon does
  // not start.
  Status live(std::function<void(int hour, const FlownHour&)> done);

  // What a service manager would have killed it for, each time that it was looked at.
  const std::vector<std::string>& hangs() const { return hangs_; }

 private:
  geodesy::Geodetic place_at(double seconds) const;
  config::Config configuration() const;
  service::DaemonEvents events();
  void say_on();
  void decided(const capture::Decision& decision);
  void ended(const std::string& folder);
  void plan_hour(int hour);
  void look();
  void end_hour();

  int hours_;
  std::string folder_;
  geodesy::LocalFrame frame_;
  sim::ClimbPath path_;
  sim::VirtualClock clock_;
  sim::GnssStream stream_;
  sim::SimReceiver receiver_;
  sim::SimCamera camera_;
  ScriptedPilot pilot_;
  sim::SimDisk disk_;
  std::unique_ptr<service::Daemon> daemon_;
  std::uint64_t rounds_ = 0;
  Flown flown_;  // of the flight that is under way
  FlownHour hour_;
  std::function<void(int hour, const FlownHour&)> done_;
  int hours_done_ = 0;
  std::vector<std::string> hangs_;
};

}  // namespace plumbline::soak
