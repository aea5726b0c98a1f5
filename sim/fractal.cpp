// SPDX-License-Identifier: MIT
#include "sim/fractal.h"

#include "edge/base/parallel.h"
#include "sim/random.h"

namespace plumbline::sim {
namespace {

std::size_t cells(int side) {
  return static_cast<std::size_t>(side) * static_cast<std::size_t>(side);
}

void add_noise_to_row(Grid& grid, int y, double amplitude, std::uint64_t key) {
  const auto a = static_cast<float>(amplitude);
  const std::uint64_t row_key = mixed(key, static_cast<std::uint64_t>(y));
  for (int x = 0; x < grid.side; ++x) {
    grid.at(x, y) += a * signed_unit(mixed(row_key ^ static_cast<std::uint64_t>(x)));
  }
}

// Chaikin: a new sample lies a quarter of the old spacing from its nearest old one.
void double_row(const Grid& coarse, Grid& fine, int y) {
  const int near_y = y / 2;
  const int far_y = (near_y + (y % 2 == 0 ? coarse.side - 1 : 1)) % coarse.side;
  for (int x = 0; x < fine.side; ++x) {
    const int near_x = x / 2;
    const int step = x % 2 == 0 ? coarse.side - 1 : 1;
    const int far_x = near_x + step >= coarse.side ? near_x + step - coarse.side : near_x + step;
    const float near_row = 0.75f * coarse.at(near_x, near_y) + 0.25f * coarse.at(far_x, near_y);
    const float far_row = 0.75f * coarse.at(near_x, far_y) + 0.25f * coarse.at(far_x, far_y);
    fine.at(x, y) = 0.75f * near_row + 0.25f * far_row;
  }
}

}  // namespace

Grid fractal(int coarse_side, const std::vector<double>& amplitudes, std::uint64_t seed,
             int threads) {
  Grid grid{coarse_side, std::vector<float>(cells(coarse_side), 0.0f)};
  for (std::size_t octave = 0; octave < amplitudes.size(); ++octave) {
    Grid next = std::move(grid);
    if (octave > 0) {
      const Grid coarse = std::move(next);
      next = {2 * coarse.side, std::vector<float>(cells(2 * coarse.side))};
      parallel_for(next.side, threads, [&](int y) { double_row(coarse, next, y); });
    }
    const std::uint64_t key = mixed(seed, octave);
    parallel_for(next.side, threads,
                 [&](int y) { add_noise_to_row(next, y, amplitudes[octave], key); });
    grid = std::move(next);
  }
  return grid;
}

}  // namespace plumbline::sim
