// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace plumbline {

// Indices are int here (-1 = none); containers want std::size_t.
inline std::size_t at(int index) { return static_cast<std::size_t>(index); }

}  // namespace plumbline
