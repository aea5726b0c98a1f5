// SPDX-License-Identifier: MIT
#include "tests/hil/host/timeline.h"

#include <array>

namespace plumbline::hil {
namespace {

std::string seconds_text(std::chrono::duration<double> time) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%7.1f s", time.count());
  return text.data();
}

}  // namespace

void Timeline::tie_guest(double uptime_s, SteadyTime now) {
  guest_began_ = now - std::chrono::duration_cast<std::chrono::nanoseconds>(
                           std::chrono::duration<double>(uptime_s));
}

void Timeline::say(const std::string& text) {
  const SteadyTime now = std::chrono::steady_clock::now();
  std::string line = seconds_text(now - began_) + "   guest ";
  line += guest_began_ ? seconds_text(now - *guest_began_) : "        -";
  line += "   flight " + (took_off_ ? seconds_text(now - *took_off_) : "        -");
  line += "   " + text + "\n";
  for (std::FILE* out : {stdout, file_}) {
    if (out == nullptr) continue;
    std::fputs(line.c_str(), out);
    std::fflush(out);
  }
}

}  // namespace plumbline::hil
