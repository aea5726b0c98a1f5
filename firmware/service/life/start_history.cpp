// SPDX-License-Identifier: MIT
#include "firmware/service/life/start_history.h"

#include <filesystem>
#include <fstream>

namespace plumbline::service {
namespace {

constexpr std::chrono::minutes kLately{1};

}  // namespace

// What is no such line, or of another boot, does not count.
std::vector<HostTime> StartHistory::of_late(HostTime now) const {
  std::vector<HostTime> starts;
  std::ifstream file(file_);
  std::string boot;
  std::int64_t nanoseconds = 0;
  while (file >> boot >> nanoseconds) {
    const HostTime start{std::chrono::nanoseconds(nanoseconds)};
    if (boot == boot_ && start <= now && now - start <= kLately) starts.push_back(start);
  }
  return starts;
}

// By another name first: a program that is killed here leaves the file as it was.
bool StartHistory::keep(const std::vector<HostTime>& starts) const {
  const std::string part = file_ + ".part";
  std::ofstream file(part, std::ios::trunc);
  for (const HostTime start : starts) {
    file << boot_ << ' ' << start.time_since_epoch().count() << '\n';
  }
  file.close();
  std::error_code error;
  if (file.good()) std::filesystem::rename(part, file_, error);
  return file.good() && !error;
}

int StartHistory::begin(HostTime now) {
  std::vector<HostTime> starts = of_late(now);
  const int failures = static_cast<int>(starts.size());
  starts.push_back(now);
  return keep(starts) ? failures : 0;
}

void StartHistory::end_well() {
  std::error_code none;
  std::filesystem::remove(file_, none);
}

}  // namespace plumbline::service
