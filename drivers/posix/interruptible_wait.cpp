// SPDX-License-Identifier: MIT
#include "drivers/posix/interruptible_wait.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <ctime>

namespace plumbline::posix {
namespace {

timespec timespec_of(std::chrono::nanoseconds time) {
  const auto kept = std::max(time, std::chrono::nanoseconds::zero());
  const auto seconds = std::chrono::floor<std::chrono::seconds>(kept);
  return {static_cast<std::time_t>(seconds.count()), static_cast<long>((kept - seconds).count())};
}

}  // namespace

InterruptibleWait::InterruptibleWait() : wake_up_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

void InterruptibleWait::interrupt() {
  const std::uint64_t one = 1;
  // Fails only where the counter is full, and then the wait ends all the same.
  [[maybe_unused]] const auto written = ::write(wake_up_.get(), &one, sizeof one);
}

short InterruptibleWait::wait(int fd, short events, std::chrono::nanoseconds at_most) {
  std::array<pollfd, 2> watched{pollfd{fd, events, 0}, pollfd{wake_up_.get(), POLLIN, 0}};
  const timespec timeout = timespec_of(at_most);
  if (::ppoll(watched.data(), watched.size(), &timeout, nullptr) <= 0) return 0;
  if (watched[1].revents != 0) {
    std::uint64_t count = 0;
    [[maybe_unused]] const auto taken = ::read(wake_up_.get(), &count, sizeof count);
    return 0;
  }
  return watched[0].revents;
}

}  // namespace plumbline::posix
