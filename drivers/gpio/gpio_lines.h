// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/base/time.h"

namespace plumbline::gpio {

// What of libgpiod is needed, the same over its two incompatible generations: gpio_lines_v1.cpp is
// built with 1.x, gpio_lines_v2.cpp with 2.x.

enum class Bias { kAsIs, kDisabled, kPullUp, kPullDown };

struct LineSettings {
  // "gpiochip0:17", "/dev/gpiochip0:17", or the name of a line ("SHUTTER"), looked for on all
  // chips.
  std::string line;
  bool active_low = false;
  Bias bias = Bias::kAsIs;
};

class OutputLine {
 public:
  virtual ~OutputLine() = default;  // releases the line
  virtual Status set(bool active) = 0;
};

struct RawEdge {
  HostTime time;  // of the kernel, in its interrupt
  bool rising = true;
  std::optional<std::uint64_t> sequence;  // from 1, of this line; empty: the kernel does not say
};

class InputLine {
 public:
  virtual ~InputLine() = default;
  virtual int descriptor() const = 0;  // readable when there are edges
  // What has queued up, the oldest first; call it when the descriptor is readable. Fails when the
  // chip is gone.
  virtual Result<std::vector<RawEdge>> read() = 0;
};

// Inactive at first.
Result<std::unique_ptr<OutputLine>> open_output(const LineSettings& settings);
Result<std::unique_ptr<InputLine>> open_input(const LineSettings& settings);

// The chip's device and the line's offset in "gpiochip0:17"; empty where it is a line's name.
struct ChipAndOffset {
  std::string chip_path;
  unsigned offset = 0;
};
std::optional<ChipAndOffset> chip_and_offset(const std::string& line);

// The device files of all chips, in order.
std::vector<std::string> chip_paths();

Error line_error(const std::string& attempted, const std::string& line, int code);

}  // namespace plumbline::gpio
