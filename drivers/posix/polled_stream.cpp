// SPDX-License-Identifier: MIT
#include "drivers/posix/polled_stream.h"

#include <poll.h>

#include <cerrno>

namespace plumbline::posix {

// What came before a hang-up is read first: read() then returns it, and only then 0 or a fault.
ByteStream::Reading PolledStream::read(std::chrono::nanoseconds at_most) {
  if (!descriptor_.is_open()) return gone(EBADF);
  const short happened = wait_.wait(descriptor_.get(), POLLIN, at_most);
  if (happened == 0) return {Arrival::kNothing, {}, {}};
  const ssize_t count = get(buffer_.data(), buffer_.size());
  if (count > 0) {
    return {Arrival::kBytes, {buffer_.data(), static_cast<std::size_t>(count)}, {}};
  }
  if (count == 0) return gone(0);
  const int fault = errno;
  const bool again = fault == EINTR || fault == EAGAIN;
  const bool broken = (happened & (POLLHUP | POLLERR | POLLNVAL)) != 0;
  if (again && !broken) return {Arrival::kNothing, {}, {}};
  return gone(fault);
}

std::size_t PolledStream::write(std::string_view bytes) {
  if (!descriptor_.is_open()) return 0;
  const ssize_t count = put(bytes);
  return count > 0 ? static_cast<std::size_t>(count) : 0;
}

ByteStream::Reading PolledStream::gone(int fault) {
  close();
  return {Arrival::kGone, {}, name() + " " + why_gone(fault)};
}

}  // namespace plumbline::posix
