// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <optional>

#include "edge/base/image.h"
#include "sim/pyramid.h"

namespace plumbline::sim {

struct TextureOptions {
  double half_extent_m = 125;
  double texel_m = 0.05;        // of the painted ground; finer detail comes from `detail`
  double photo_texel_m = 0.02;  // one pixel of a photo used as ground, metres
  std::uint64_t seed = 1;
  int threads = 1;
};

// The size of ground that one sample stands for.
struct Footprint {
  explicit Footprint(double size_m)
      : metres(static_cast<float>(size_m)), log2_metres(std::log2(static_cast<float>(size_m))) {}

  float metres;
  float log2_metres;
};

// The colour of the ground as seen from above, red, green, blue 0..255: painted once for the whole
// world at `texel_m` (soil, grass, stones, tracks, or a real photo), and below that scale a detail
// of 1 cm and finer, laid over it twice at different turns and sizes so that it does not repeat.
class GroundTexture {
 public:
  // `photo` (3 channels) stands for the painted soil and grass where given: tiled, with every
  // other tile mirrored so that the edges meet.
  GroundTexture(const TextureOptions& options, const std::optional<Image>& photo);

  Eigen::Vector3f colour(double east_m, double north_m, const Footprint& footprint) const;

  // The detail alone: 0 in the mean, mostly within +-0.5.
  float detail(double east_m, double north_m, const Footprint& footprint) const;

 private:
  double half_extent_m_;
  double texel_m_;
  float log2_texel_m_;
  bool from_photo_;
  Pyramid<4> paint_;
  Pyramid<1> detail_;
};

}  // namespace plumbline::sim
