// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "edge/base/result.h"
#include "tests/hil/host/drone.h"
#include "tests/hil/host/line_socket.h"
#include "tests/hil/host/timeline.h"
#include "tests/hil/host/virtual_machine.h"

namespace plumbline::hil {

// The virtual companion computer as its user has it: a root shell, what the daemon says of itself,
// and the hand at its cables. One thread. What the daemon says anew goes into the timeline, which
// outlives it.
class Companion {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;
  using Json = nlohmann::json;

  // `sockets`: the folder of hil_start_system.
  Companion(std::string sockets, Timeline& timeline);

  // To a machine that has been started; returns when it is up.
  Status connect(std::chrono::seconds at_most);
  // The same to what the daemon says, of a machine that need not be up yet.
  Status listen();

  // In the shell.
  Status order(const std::string& command);
  // As its user does: the camera's calibration, the heights, and the lines where there are some.
  // Restarts the daemon.
  Status configure(const sim::BenchFlight& flight, const DroneOptions& options);

  // Until what the daemon says is so, with what is to be done meanwhile, every 100 ms. What was
  // read of it before the call does not count.
  Status wait_until(const std::string& what, const std::function<bool(const Json&)>& is_so,
                    SteadyTime deadline, const std::function<void()>& meanwhile = {});
  static bool is_ready(const Json& status);

  Cables& cables() { return cables_; }

 private:
  void follow(const Json& status);

  std::string sockets_;
  Timeline& timeline_;
  GuestShell shell_;
  Cables cables_;
  LineSocket status_lines_;
  std::string shown_;
};

}  // namespace plumbline::hil
