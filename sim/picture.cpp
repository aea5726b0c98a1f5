// SPDX-License-Identifier: MIT
#include "sim/picture.h"

#include <algorithm>
#include <cmath>

#include "edge/base/parallel.h"
#include "sim/random.h"

namespace plumbline::sim {
namespace {

std::vector<float> gaussian(double sigma_px) {
  const int reach = std::max(1, static_cast<int>(std::ceil(4 * sigma_px)));
  std::vector<float> weights;
  double sum = 0;
  for (int k = -reach; k <= reach; ++k) {
    const double weight = sigma_px > 0 ? std::exp(-0.5 * k * k / (sigma_px * sigma_px)) : k == 0;
    weights.push_back(static_cast<float>(weight));
    sum += weight;
  }
  for (float& weight : weights) weight = static_cast<float>(weight / sum);
  return weights;
}

void blur_along_row(Picture& picture, int v, const std::vector<float>& weights) {
  const int reach = static_cast<int>(weights.size()) / 2;
  float* row = picture.row(v);
  const int width = picture.width_px;
  const std::vector<float> sharp(row, row + 3 * width);
  for (int u = 0; u < width; ++u) {
    float sum[3] = {0, 0, 0};
    for (int k = -reach; k <= reach; ++k) {
      const auto from = static_cast<std::size_t>(3 * std::clamp(u + k, 0, width - 1));
      const float weight = weights[static_cast<std::size_t>(k + reach)];
      for (std::size_t c = 0; c < 3; ++c) sum[c] += weight * sharp[from + c];
    }
    for (int c = 0; c < 3; ++c) row[3 * u + c] = sum[c];
  }
}

std::vector<float> blurred_down(const Picture& picture, int v, const std::vector<float>& weights) {
  const int reach = static_cast<int>(weights.size()) / 2;
  std::vector<float> blurred(3 * static_cast<std::size_t>(picture.width_px), 0.0f);
  for (int k = -reach; k <= reach; ++k) {
    const float* from = picture.row(std::clamp(v + k, 0, picture.height_px - 1));
    const float weight = weights[static_cast<std::size_t>(k + reach)];
    for (std::size_t i = 0; i < blurred.size(); ++i) blurred[i] += weight * from[i];
  }
  return blurred;
}

// The mean along a straight streak, nearest pixels at half-pixel steps.
Picture streaked(const Picture& sharp, const SensorOptions& sensor, int threads) {
  Picture picture = sharp;
  const int steps = static_cast<int>(std::ceil(sensor.motion_blur_px)) * 2;
  const double du = std::cos(sensor.motion_direction_rad) * sensor.motion_blur_px;
  const double dv = std::sin(sensor.motion_direction_rad) * sensor.motion_blur_px;
  parallel_for(sharp.height_px, threads, [&](int v) {
    float* row = picture.row(v);
    std::fill(row, row + 3 * sharp.width_px, 0.0f);
    for (int k = 0; k <= steps; ++k) {
      const double part = static_cast<double>(k) / steps - 0.5;
      const int from_v = v + static_cast<int>(std::lround(part * dv));
      const float* from = sharp.row(std::clamp(from_v, 0, sharp.height_px - 1));
      const int shift = static_cast<int>(std::lround(part * du));
      for (int u = 0; u < sharp.width_px; ++u) {
        const int from_u = std::clamp(u + shift, 0, sharp.width_px - 1);
        for (int c = 0; c < 3; ++c) {
          row[3 * u + c] += from[3 * from_u + c] / static_cast<float>(steps + 1);
        }
      }
    }
  });
  return picture;
}

// Share of the light that reaches a pixel, 1 in the middle of the photo.
float passed(const Picture& picture, int u, int v, double vignetting) {
  const double x = 2.0 * u / picture.width_px - 1;
  const double y = (2.0 * v - picture.height_px) / picture.width_px;
  const double corner = 1 + std::pow(1.0 * picture.height_px / picture.width_px, 2);
  return static_cast<float>(1 - vignetting * (x * x + y * y) / corner);
}

std::uint8_t exposed(float light, const SensorOptions& sensor, std::uint64_t hash) {
  const auto variance = static_cast<float>(sensor.read_variance) +
                        static_cast<float>(sensor.shot_variance) * std::max(light, 0.0f);
  const float noisy = light + std::sqrt(variance) * rough_normal(hash);
  return static_cast<std::uint8_t>(std::clamp(noisy + 0.5f, 0.0f, 255.0f));
}

}  // namespace

Image develop(Picture picture, const SensorOptions& sensor, std::uint64_t seed, int threads) {
  if (sensor.motion_blur_px > 0) picture = streaked(picture, sensor, threads);
  const std::vector<float> weights = gaussian(sensor.blur_sigma_px);
  parallel_for(picture.height_px, threads, [&](int v) { blur_along_row(picture, v, weights); });
  Image image{picture.width_px, picture.height_px, 3, {}};
  image.data.resize(picture.light.size());
  parallel_for(picture.height_px, threads, [&](int v) {
    const std::vector<float> light = blurred_down(picture, v, weights);
    const std::uint64_t key = mixed(seed, static_cast<std::uint64_t>(v));
    std::uint8_t* row = &image.data[image.index(0, v)];
    for (std::size_t i = 0; i < light.size(); ++i) {
      const float share = passed(picture, static_cast<int>(i / 3), v, sensor.vignetting);
      row[i] = exposed(light[i] * share, sensor, mixed(key ^ i));
    }
  });
  return image;
}

}  // namespace plumbline::sim
