// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <ostream>

namespace plumbline::soak {

// What this process holds now.
struct InUse {
  std::int64_t blocks = 0;  // of memory, that operator new gave and delete has not taken back
  std::int64_t bytes = 0;   // in them, with what the allocator rounded up
  int descriptors = 0;

  bool operator==(const InUse&) const = default;
};
inline void PrintTo(const InUse& in_use, std::ostream* out) {
  *out << in_use.blocks << " blocks, " << in_use.bytes << " bytes, " << in_use.descriptors
       << " descriptors";
}

InUse in_use();

}  // namespace plumbline::soak
