// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace plumbline::jpeg {

// The same JPEG with the tables that its entropy-coded data are read by. Cameras that send a JPEG a
// frame leave them out, for they are always those of ITU-T T.81, annex K.3; as a file it is then no
// JPEG, and many readers refuse it. They are put before the first scan. A JPEG that brings any
// table of its own, or has no scan, is returned as it is. Reentrant.
std::vector<std::uint8_t> with_huffman_tables(std::span<const std::uint8_t> bytes);

}  // namespace plumbline::jpeg
