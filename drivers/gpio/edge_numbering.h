// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/gpio/gpio_lines.h"
#include "drivers/trigger_line.h"

namespace plumbline::gpio {

// Gives edges their numbers, and finds those that the kernel's queue had no room for: by the
// kernel's own numbers where it gives any (libgpiod 2), else by two edges of the same direction in
// a row, between which one of the other must be missing. Lost pairs are then not seen.
class EdgeNumbering {
 public:
  std::vector<LineEvent> number(const std::vector<RawEdge>& edges);

 private:
  std::uint64_t lost_before(const RawEdge& edge) const;

  std::uint64_t next_ = 0;
  std::optional<RawEdge> last_;
};

}  // namespace plumbline::gpio
