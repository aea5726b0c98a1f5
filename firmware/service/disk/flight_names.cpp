// SPDX-License-Identifier: MIT
#include "firmware/service/disk/flight_names.h"

#include <algorithm>
#include <utility>

namespace plumbline::service {

std::vector<std::string> flights_among(std::vector<std::string> names) {
  std::erase_if(names, [](const std::string& name) {
    return name.size() < 4 || name.find_first_not_of("0123456789") != std::string::npos;
  });
  std::sort(names.begin(), names.end(), [](const std::string& a, const std::string& b) {
    return std::pair(a.size(), a) < std::pair(b.size(), b);
  });
  return names;
}

}  // namespace plumbline::service
