// SPDX-License-Identifier: MIT
#include "drivers/posix/file_stream.h"

#include <fcntl.h>

#include <cerrno>
#include <cstring>

namespace plumbline::posix {

ByteStream::Opening FileStream::open() {
  close();
  descriptor_ = Descriptor(::open(path_.c_str(), O_RDONLY | O_CLOEXEC));
  if (descriptor_.is_open()) return {Presence::kOpen, {}};
  return {Presence::kRefused, "Cannot read " + path_ + ": " + std::strerror(errno) +
                                  "; name a log that is there, or a port."};
}

ByteStream::Reading FileStream::read(std::chrono::nanoseconds /*at_most*/) {
  const ssize_t count = ::read(descriptor_.get(), buffer_.data(), buffer_.size());
  if (count > 0) {
    return {Arrival::kBytes, {buffer_.data(), static_cast<std::size_t>(count)}, {}};
  }
  if (count == 0) return end("The log " + path_ + " has ended.");
  if (errno == EINTR) return {Arrival::kNothing, {}, {}};
  return end("The log " + path_ + " cannot be read on: " + std::strerror(errno) + ".");
}

ByteStream::Reading FileStream::end(const std::string& sentence) {
  close();
  return {Arrival::kEnd, {}, sentence};
}

}  // namespace plumbline::posix
