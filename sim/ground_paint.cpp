// SPDX-License-Identifier: MIT
#include "sim/ground_paint.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "edge/base/parallel.h"
#include "sim/fractal.h"
#include "sim/random.h"

namespace plumbline::sim {
namespace {

constexpr int kOctaves = 10;      // 512 texels down to 1
constexpr int kCoverOctaves = 7;  // what grows where: 8 texels are enough
constexpr int kTexelsPerCover = 1 << (kOctaves - kCoverOctaves);
constexpr int kDetailOctaves = 8;
constexpr int kDetailCoarse = 16;  // 16 * 2^7 = 2048 texels

const Eigen::Vector3f kSoil(158, 136, 106);
const Eigen::Vector3f kSand(186, 168, 136);
const Eigen::Vector3f kGrass(104, 118, 68);
const Eigen::Vector3f kDryGrass(150, 142, 92);

std::uint8_t byte(float value) {
  return static_cast<std::uint8_t>(std::clamp(value + 0.5f, 0.0f, 255.0f));
}

float step_between(float low, float high, float x) {
  const float t = std::clamp((x - low) / (high - low), 0.0f, 1.0f);
  return t * t * (3 - 2 * t);
}

float smooth_at(const Grid& grid, double x, double y) {
  const int i = std::clamp(static_cast<int>(x), 0, grid.side - 2);
  const int j = std::clamp(static_cast<int>(y), 0, grid.side - 2);
  const auto a = static_cast<float>(x - i);
  const auto b = static_cast<float>(y - j);
  return (1 - b) * ((1 - a) * grid.at(i, j) + a * grid.at(i + 1, j)) +
         b * ((1 - a) * grid.at(i, j + 1) + a * grid.at(i + 1, j + 1));
}

// Two ruts 1.7 m apart along a gentle wave; 1 in a rut, 0 beside it.
float track(double east_m, double north_m) {
  const double along_m = 0.8 * east_m + 0.6 * north_m;
  const double across_m = 0.8 * north_m - 0.6 * east_m;
  const double axis_m = 7.0 + 5.0 * std::sin(along_m / 23.0) + 1.5 * std::sin(along_m / 7.7);
  const double from_rut_m = std::abs(std::abs(across_m - axis_m) - 0.85);
  return 1 - step_between(0.12f, 0.35f, static_cast<float>(from_rut_m));
}

struct Canvas {
  int side;
  int channels;
  std::vector<std::uint8_t>& texels;

  std::uint8_t* at(int x, int y) const {
    const auto fold = [&](int i) { return static_cast<std::size_t>(((i % side) + side) % side); };
    return &texels[(fold(y) * static_cast<std::size_t>(side) + fold(x)) *
                   static_cast<std::size_t>(channels)];
  }
};

// A spot with soft edges: an ellipse, lit from the south-east, blended over the canvas.
struct Spot {
  Eigen::Vector2f centre;  // texels
  float long_radius = 1;   // texels
  float short_radius = 1;
  float turn_rad = 0;
  float bulge = 0;  // brightness gained on the lit side, lost on the other
  Eigen::Vector3f colour = Eigen::Vector3f::Zero();
};

void draw(const Canvas& canvas, const Spot& spot) {
  const int reach = static_cast<int>(std::ceil(spot.long_radius + 1));
  const auto x0 = static_cast<int>(std::lround(spot.centre.x()));
  const auto y0 = static_cast<int>(std::lround(spot.centre.y()));
  const float c = std::cos(spot.turn_rad);
  const float s = std::sin(spot.turn_rad);
  const int colours = std::min(canvas.channels, 3);
  for (int y = y0 - reach; y <= y0 + reach; ++y) {
    for (int x = x0 - reach; x <= x0 + reach; ++x) {
      const Eigen::Vector2f d(static_cast<float>(x) - spot.centre.x(),
                              static_cast<float>(y) - spot.centre.y());
      const float along = (c * d.x() + s * d.y()) / spot.long_radius;
      const float across = (c * d.y() - s * d.x()) / spot.short_radius;
      const float inside = (1 - std::hypot(along, across)) * spot.short_radius + 0.5f;
      const float cover = std::clamp(inside, 0.0f, 1.0f);
      if (cover <= 0) continue;
      const float light = spot.bulge * (d.x() - d.y()) / spot.long_radius;
      std::uint8_t* texel = canvas.at(x, y);
      for (int k = 0; k < colours; ++k) {
        texel[k] = byte((1 - cover) * texel[k] + cover * (spot.colour[k] + light));
      }
    }
  }
}

float size_between(Random& random, double smallest, double largest) {  // small ones are many
  return static_cast<float>(smallest *
                            std::pow(largest / smallest, std::pow(random.uniform(), 2.5)));
}

Spot random_spot(Random& random, int side, float radius) {
  Spot spot;
  spot.centre = {static_cast<float>(random.uniform(0, side)),
                 static_cast<float>(random.uniform(0, side))};
  spot.long_radius = radius;
  spot.short_radius = radius * static_cast<float>(random.uniform(0.55, 1.0));
  spot.turn_rad = static_cast<float>(random.uniform(0, std::numbers::pi));
  return spot;
}

void scatter_stones(const Canvas& canvas, double texel_m, double per_m2, Random& random) {
  const double area_m2 = std::pow(canvas.side * texel_m, 2);
  for (int k = 0; k < static_cast<int>(per_m2 * area_m2); ++k) {
    Spot stone = random_spot(random, canvas.side,
                             size_between(random, 0.04, 0.35) / static_cast<float>(texel_m));
    const auto grey = static_cast<float>(random.uniform(95, 215));
    stone.colour = {grey, 0.97f * grey, 0.91f * grey};
    stone.bulge = 22;
    draw(canvas, stone);
  }
}

void scatter_tufts(const Canvas& canvas, double texel_m, double per_m2, Random& random) {
  const double area_m2 = std::pow(canvas.side * texel_m, 2);
  for (int k = 0; k < static_cast<int>(per_m2 * area_m2); ++k) {
    Spot tuft = random_spot(random, canvas.side,
                            size_between(random, 0.05, 0.3) / static_cast<float>(texel_m));
    tuft.colour = static_cast<float>(random.uniform(0.45, 0.95)) * kGrass;
    tuft.bulge = 14;
    draw(canvas, tuft);
  }
}

}  // namespace

Painting paint_ground(int side, double texel_m, std::uint64_t seed, int threads) {
  const int coarse = (side + (1 << (kOctaves - 1)) - 1) >> (kOctaves - 1);
  const Grid brightness =
      fractal(coarse, {0.05, 0.05, 0.06, 0.07, 0.08, 0.09, 0.10, 0.12, 0.15, 0.20}, mixed(seed, 1),
              threads);
  const Grid cover = fractal(coarse, {0.5, 0.5, 0.4, 0.3, 0.25, 0.2, 0.2}, mixed(seed, 2), threads);
  const Grid dryness =
      fractal(coarse, {0.5, 0.4, 0.3, 0.3, 0.2, 0.2, 0.1}, mixed(seed, 3), threads);
  Painting painting{brightness.side, {}};
  const auto texels = static_cast<std::size_t>(brightness.side);
  const int middle = side / 2;
  painting.texels.assign(4 * texels * texels, 0);
  parallel_for(brightness.side, threads, [&](int y) {
    for (int x = 0; x < brightness.side; ++x) {
      const double cx = static_cast<double>(x) / kTexelsPerCover;
      const double cy = static_cast<double>(y) / kTexelsPerCover;
      const float rut = track((x - middle) * texel_m, (y - middle) * texel_m);
      const float fine = brightness.at(x, y);
      const float grows = smooth_at(cover, cx, cy) + 0.6f * fine - 0.6f * rut;
      const float dry = step_between(-0.5f, 0.5f, smooth_at(dryness, cx, cy) + 0.4f * rut);
      const float green = 0.85f * step_between(-0.12f, 0.22f, grows);
      const Eigen::Vector3f soil = kSoil + dry * (kSand - kSoil);
      const Eigen::Vector3f grass = kGrass + dry * (kDryGrass - kGrass);
      const Eigen::Vector3f colour = (soil + green * (grass - soil)) * (1 + fine);
      std::uint8_t* texel =
          &painting
               .texels[4 * (static_cast<std::size_t>(y) * texels + static_cast<std::size_t>(x))];
      for (int k = 0; k < 3; ++k) texel[k] = byte(colour[k]);
    }
  });
  Random random(seed, 4);
  const Canvas canvas{painting.side, 4, painting.texels};
  scatter_tufts(canvas, texel_m, 0.5, random);
  scatter_stones(canvas, texel_m, 0.5, random);
  return painting;
}

Painting paint_detail(std::uint64_t seed, int threads) {
  const Grid grains =
      fractal(kDetailCoarse, {0, 0, 0.04, 0.06, 0.10, 0.14, 0.20, 0.30}, mixed(seed, 5), threads);
  static_assert(kDetailCoarse << (kDetailOctaves - 1) == 2048);
  Painting painting{grains.side, {}};
  painting.texels.reserve(grains.values.size());
  for (const float grain : grains.values) painting.texels.push_back(byte(128 + 127 * grain));
  Random random(seed, 6);
  const Canvas canvas{painting.side, 1, painting.texels};
  for (int k = 0; k < 40000; ++k) {
    const bool blade = k % 2 == 0;
    Spot spot = random_spot(
        random, painting.side,
        blade ? static_cast<float>(random.uniform(2, 6)) : size_between(random, 0.8, 4.0));
    if (blade) spot.short_radius = 0.6f;
    spot.colour.setConstant(static_cast<float>(random.uniform(60, 205)));
    spot.bulge = blade ? 0.0f : 25.0f;
    draw(canvas, spot);
  }
  return painting;
}

}  // namespace plumbline::sim
