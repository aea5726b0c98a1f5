// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdio>
#include <optional>
#include <string>

namespace plumbline::hil {

// What happened, by the clocks of host, guest and flight.
class Timeline {
 public:
  using SteadyTime = std::chrono::steady_clock::time_point;

  // Also into a file.
  explicit Timeline(const std::string& path) : file_(std::fopen(path.c_str(), "w")) {}
  Timeline(const Timeline&) = delete;
  Timeline& operator=(const Timeline&) = delete;
  ~Timeline() {
    if (file_ != nullptr) std::fclose(file_);
  }

  // Seconds since the guest's kernel began, at `now`.
  void tie_guest(double uptime_s, SteadyTime now);
  // The guest's kernel runs no more.
  void untie_guest() { guest_began_.reset(); }
  void take_off(SteadyTime at) { took_off_ = at; }

  void say(const std::string& text);

 private:
  std::FILE* file_;
  SteadyTime began_ = std::chrono::steady_clock::now();
  std::optional<SteadyTime> guest_began_;
  std::optional<SteadyTime> took_off_;
};

}  // namespace plumbline::hil
