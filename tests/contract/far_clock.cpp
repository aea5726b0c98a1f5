// SPDX-License-Identifier: MIT
#include "tests/contract/far_clock.h"

#include <fcntl.h>
#include <poll.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

namespace plumbline::contract {

FarClock::FarClock(const std::string& path)
    : port_(::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NOCTTY)) {}

void FarClock::say(std::string_view line) {
  const std::string whole = std::string(line) + "\n";
  [[maybe_unused]] const ssize_t sent = ::write(port_.get(), whole.data(), whole.size());
}

std::optional<ClockTie> FarClock::tie() {
  constexpr int kTrips = 200;
  std::optional<ClockTie> best;
  for (int trip = 0; trip < kTrips; ++trip) {
    const auto tie = ask();
    if (!tie) return std::nullopt;
    if (!best || tie->doubt < best->doubt) best = tie;
  }
  return best;
}

std::optional<ClockTie> FarClock::ask() {
  const HostTime before = clock_.now();
  say("time");
  const auto theirs_ns = answer();
  const HostTime after = clock_.now();
  if (!theirs_ns) return std::nullopt;
  const std::chrono::nanoseconds half = (after - before) / 2;
  return ClockTie{before + half, *theirs_ns, half};
}

std::optional<std::int64_t> FarClock::answer() {
  std::string line;
  pollfd wait{port_.get(), POLLIN, 0};
  while (::poll(&wait, 1, 1000) > 0) {
    char letter = 0;
    if (::read(port_.get(), &letter, 1) != 1) return std::nullopt;
    if (letter == '\n') return std::atoll(line.c_str());
    line += letter;
  }
  return std::nullopt;
}

HostTime ours_of(std::int64_t theirs_ns, const ClockTie& first, const ClockTie& last) {
  const double rate = static_cast<double>((last.ours - first.ours).count()) /
                      static_cast<double>(last.theirs_ns - first.theirs_ns);
  const auto since_first = static_cast<double>(theirs_ns - first.theirs_ns);
  return first.ours + std::chrono::nanoseconds(std::llround(since_first * rate));
}

}  // namespace plumbline::contract
