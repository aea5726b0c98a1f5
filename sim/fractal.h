// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

namespace plumbline::sim {

// A square grid of numbers, row by row.
struct Grid {
  int side = 0;
  std::vector<float> values;  // side * side

  float& at(int x, int y) {
    return values[static_cast<std::size_t>(y) * static_cast<std::size_t>(side) +
                  static_cast<std::size_t>(x)];
  }
  float at(int x, int y) const { return const_cast<Grid*>(this)->at(x, y); }
};

// Random ground at every scale: starts with a coarse grid of uniform noise of amplitude
// amplitudes[0] and, for each further entry, doubles the resolution by a quadratic B-spline
// (Chaikin 1974) and adds noise of that amplitude. Periodic: the right edge continues at the left.
// The side of the result is coarse_side * 2^(amplitudes.size() - 1).
Grid fractal(int coarse_side, const std::vector<double>& amplitudes, std::uint64_t seed,
             int threads);

}  // namespace plumbline::sim
