// SPDX-License-Identifier: MIT
#include "sim/ground_texture.h"

#include <cmath>

#include "sim/ground_paint.h"

namespace plumbline::sim {
namespace {

constexpr double kDetailTexel_m = 0.01;
constexpr float kLog2DetailTexel = -6.643856f;
constexpr int kPaintLevels = 7;
constexpr int kDetailLevels = 9;

Pyramid<4> photo_pyramid(const Image& photo) {
  std::vector<std::uint8_t> texels;
  texels.reserve(photo.data.size() / 3 * 4);
  for (std::size_t k = 0; k < photo.data.size(); k += 3) {
    texels.insert(texels.end(), {photo.data[k], photo.data[k + 1], photo.data[k + 2], 0});
  }
  return {photo.width_px, photo.height_px, std::move(texels), kPaintLevels, Edge::kMirror};
}

Pyramid<4> painted_pyramid(const TextureOptions& options) {
  const int side = static_cast<int>(std::ceil(2 * options.half_extent_m / options.texel_m));
  Painting painting = paint_ground(side, options.texel_m, options.seed, options.threads);
  return {painting.side, painting.side, std::move(painting.texels), kPaintLevels, Edge::kRepeat};
}

Pyramid<1> detail_pyramid(const TextureOptions& options) {
  Painting painting = paint_detail(options.seed, options.threads);
  return {painting.side, painting.side, std::move(painting.texels), kDetailLevels, Edge::kRepeat};
}

}  // namespace

GroundTexture::GroundTexture(const TextureOptions& options, const std::optional<Image>& photo)
    : half_extent_m_(options.half_extent_m),
      texel_m_(photo ? options.photo_texel_m : options.texel_m),
      log2_texel_m_(std::log2(static_cast<float>(texel_m_))),
      from_photo_(photo.has_value()),
      paint_(photo ? photo_pyramid(*photo) : painted_pyramid(options)),
      detail_(detail_pyramid(options)) {}

float GroundTexture::detail(double east_m, double north_m, const Footprint& footprint) const {
  constexpr double kC = 0.9563, kS = 0.2924;  // 17 degrees
  constexpr double kFiner = 1.5811;
  const double x = (kC * east_m + kS * north_m) / kDetailTexel_m;
  const double y = (kC * north_m - kS * east_m) / kDetailTexel_m;
  const float level = footprint.log2_metres - kLog2DetailTexel;
  const float coarse = detail_.at(x, y, level)[0];
  const float fine = detail_.at(kFiner * (0.6 * x + 0.8 * y) + 511.7,
                                kFiner * (0.6 * y - 0.8 * x) - 77.3, level + 0.661f)[0];
  return (coarse - 128) / 128 + (fine - 128) / 128;
}

Eigen::Vector3f GroundTexture::colour(double east_m, double north_m,
                                      const Footprint& footprint) const {
  const float level = footprint.log2_metres - log2_texel_m_;
  const float fine = detail(east_m, north_m, footprint);
  const auto paint =
      paint_.at((east_m + half_extent_m_) / texel_m_, (half_extent_m_ - north_m) / texel_m_, level);
  const Eigen::Vector3f ground(paint[0], paint[1], paint[2]);
  return ground * (1 + (from_photo_ ? 0.25f : 0.65f) * fine);
}

}  // namespace plumbline::sim
