// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "drivers/byte_stream.h"
#include "drivers/posix/interruptible_wait.h"

namespace plumbline::posix {

// What serial ports and sockets have in common: a descriptor that does not block, waited for with
// poll. Whatever ends the stream closes the descriptor at once: a tty that is held open keeps its
// number, and the device comes back under the next one.
class PolledStream : public DuplexStream {
 public:
  Reading read(std::chrono::nanoseconds at_most) override;
  std::size_t write(std::string_view bytes) override;
  void close() override { descriptor_.close(); }
  void pause(std::chrono::nanoseconds time) override { wait_.wait(-1, 0, time); }
  void interrupt() override { wait_.interrupt(); }

 protected:
  // Why there are no more bytes, as the end of a sentence that begins with the stream's name;
  // `fault` is errno's, 0 for an orderly end.
  virtual std::string why_gone(int fault) const = 0;

  // One read or write of the system: the count, or -1 and errno.
  virtual ssize_t get(char* buffer, std::size_t size) {
    return ::read(descriptor_.get(), buffer, size);
  }
  virtual ssize_t put(std::string_view bytes) const {
    return ::write(descriptor_.get(), bytes.data(), bytes.size());
  }

  Descriptor descriptor_;
  InterruptibleWait wait_;

 private:
  Reading gone(int fault);

  std::array<char, 8192> buffer_;
};

}  // namespace plumbline::posix
