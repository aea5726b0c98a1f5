// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>

namespace plumbline::service {

// A flight that the program finds on the disk when it starts.
struct FoundFlight {
  std::string flight;  // "0003"
  int photos = 0;
  bool is_measured = false;  // its result is not older than its photos, or was cleaned away
};

// The newest in the folder of all flights that has at least so many photos; empty where none has.
std::optional<FoundFlight> newest_flight(const std::string& flights, int least_photos);

// Whether a flight's recording says that it is over. `folder`: the flight's.
bool has_ended(const std::string& folder);

}  // namespace plumbline::service
