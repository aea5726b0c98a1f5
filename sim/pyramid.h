// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace plumbline::sim {

// How a texture continues beyond its edge.
enum class Edge { kRepeat, kMirror };

// A texture and its halvings by 2 x 2 means, read with trilinear filtering (Williams 1983), so that
// a sample shows what its footprint covers and nothing finer. Texel (0, 0) has its CENTRE at (0,
// 0).
template <int Channels>
class Pyramid {
 public:
  using Sample = std::array<float, Channels>;

  // `texels`: width * height * Channels bytes, rows of interleaved channels. Width and height are
  // cut to multiples of 2^(levels - 1).
  Pyramid(int width, int height, std::vector<std::uint8_t> texels, int levels, Edge edge)
      : edge_(edge) {
    const int unit = 1 << (levels - 1);
    levels_.push_back(
        cropped(width, height, std::move(texels), width / unit * unit, height / unit * unit));
    for (int k = 1; k < levels; ++k) levels_.push_back(halved(levels_.back()));
  }

  // At (x, y) in texels of the finest level; `log2_footprint`: 0 is one texel, 1 is two.
  Sample at(double x, double y, float log2_footprint) const {
    const float deepest = static_cast<float>(levels_.size()) - 1.001f;
    const float depth = std::clamp(log2_footprint, 0.0f, deepest);
    const int k = static_cast<int>(depth);
    const float part = depth - static_cast<float>(k);
    Sample near = at_level(levels_[static_cast<std::size_t>(k)], k, x, y);
    if (part <= 0) return near;
    const Sample far = at_level(levels_[static_cast<std::size_t>(k) + 1], k + 1, x, y);
    for (std::size_t c = 0; c < Channels; ++c) near[c] += part * (far[c] - near[c]);
    return near;
  }

 private:
  struct Level {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> texels;

    const std::uint8_t* at(int x, int y) const {
      return &texels[(static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)) *
                     Channels];
    }
  };

  static Level cropped(int width, int height, std::vector<std::uint8_t> texels, int new_width,
                       int new_height) {
    if (width == new_width && height == new_height) return {width, height, std::move(texels)};
    const auto row = static_cast<std::ptrdiff_t>(width) * Channels;
    const auto new_row = static_cast<std::ptrdiff_t>(new_width) * Channels;
    Level level{new_width, new_height, {}};
    for (int y = 0; y < new_height; ++y) {
      level.texels.insert(level.texels.end(), texels.begin() + y * row,
                          texels.begin() + y * row + new_row);
    }
    return level;
  }

  static Level halved(const Level& fine) {
    Level level{fine.width / 2, fine.height / 2, {}};
    level.texels.reserve(fine.texels.size() / 4);
    for (int y = 0; y < level.height; ++y) {
      for (int x = 0; x < level.width; ++x) {
        for (int c = 0; c < Channels; ++c) {
          const int sum = fine.at(2 * x, 2 * y)[c] + fine.at(2 * x + 1, 2 * y)[c] +
                          fine.at(2 * x, 2 * y + 1)[c] + fine.at(2 * x + 1, 2 * y + 1)[c];
          level.texels.push_back(static_cast<std::uint8_t>((sum + 2) / 4));
        }
      }
    }
    return level;
  }

  // std::floor is a call on plain x86-64; textures stay far below 2^28 texels.
  static int rounded_down(double x) {
    constexpr int kLift = 1 << 28;
    return static_cast<int>(x + kLift) - kLift;
  }

  int folded(int i, int count) const {
    if (i >= 0 && i < count) return i;
    if (edge_ == Edge::kRepeat && (count & (count - 1)) == 0) return i & (count - 1);
    if (edge_ == Edge::kRepeat) return ((i % count) + count) % count;
    const int twice = ((i % (2 * count)) + 2 * count) % (2 * count);
    return twice < count ? twice : 2 * count - 1 - twice;
  }

  Sample at_level(const Level& level, int k, double x, double y) const {
    const double scale = 1.0 / static_cast<double>(1 << k);
    const double lx = (x + 0.5) * scale - 0.5;
    const double ly = (y + 0.5) * scale - 0.5;
    const int fx = rounded_down(lx);
    const int fy = rounded_down(ly);
    const auto a = static_cast<float>(lx - fx);
    const auto b = static_cast<float>(ly - fy);
    const int x0 = folded(fx, level.width);
    const int x1 = folded(fx + 1, level.width);
    const int y0 = folded(fy, level.height);
    const int y1 = folded(fy + 1, level.height);
    const std::uint8_t* corner[4] = {level.at(x0, y0), level.at(x1, y0), level.at(x0, y1),
                                     level.at(x1, y1)};
    const float weight[4] = {(1 - a) * (1 - b), a * (1 - b), (1 - a) * b, a * b};
    Sample sample;
    for (std::size_t c = 0; c < Channels; ++c) {
      sample[c] = weight[0] * corner[0][c] + weight[1] * corner[1][c] + weight[2] * corner[2][c] +
                  weight[3] * corner[3][c];
    }
    return sample;
  }

  Edge edge_;
  std::vector<Level> levels_;
};

}  // namespace plumbline::sim
