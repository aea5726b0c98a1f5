// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "edge/base/time.h"

namespace plumbline::service {

// When this program was started of late without having ended in good order. It knows by a small
// file: a line for each start, "BOOT NANOSECONDS" with the host's clock, which does not go on over
// a boot. An end in good order removes the file; a crash, a kill or a watchdog leaves it.
class StartHistory {
 public:
  // After so many failures within a minute something is to be left out.
  static constexpr int kMany = 3;

  // `boot` tells this boot of the machine from others.
  StartHistory(std::string file, std::string boot)
      : file_(std::move(file)), boot_(boot.empty() ? "unknown" : std::move(boot)) {}

  // Notes this start. How many starts of the last minute, before this one, did not end well; 0
  // where the file cannot be kept.
  int begin(HostTime now);
  void end_well();

 private:
  std::vector<HostTime> of_late(HostTime now) const;
  bool keep(const std::vector<HostTime>& starts) const;

  std::string file_;
  std::string boot_;
};

}  // namespace plumbline::service
