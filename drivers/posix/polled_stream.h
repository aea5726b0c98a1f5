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
class PolledStream : public ByteStream {
 public:
  Reading read(std::chrono::nanoseconds at_most) override;
  void close() override { descriptor_.close(); }
  void pause(std::chrono::nanoseconds time) override { wait_.wait(-1, 0, time); }
  void interrupt() override { wait_.interrupt(); }

 protected:
  // Why there are no more bytes, as the end of a sentence that begins with the stream's name;
  // `fault` is errno's, 0 for an orderly end.
  virtual std::string why_gone(int fault) const = 0;

  Descriptor descriptor_;
  InterruptibleWait wait_;

 private:
  Reading gone(int fault);

  std::array<char, 8192> buffer_;
};

}  // namespace plumbline::posix
