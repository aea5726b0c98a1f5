// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <string>

#include "drivers/posix/polled_stream.h"

namespace plumbline::posix {

// A log, read as fast as it is asked for, once.
class FileStream : public ByteStream {
 public:
  explicit FileStream(std::string path) : path_(std::move(path)) {}

  Opening open() override;
  Reading read(std::chrono::nanoseconds at_most) override;
  void close() override { descriptor_.close(); }
  void pause(std::chrono::nanoseconds time) override { wait_.wait(-1, 0, time); }
  void interrupt() override { wait_.interrupt(); }
  std::string name() const override { return path_; }

 private:
  Reading end(const std::string& sentence);

  std::string path_;
  Descriptor descriptor_;
  InterruptibleWait wait_;
  std::array<char, 65536> buffer_;
};

}  // namespace plumbline::posix
