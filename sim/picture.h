// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "edge/base/image.h"
#include "sim/renderer.h"

namespace plumbline::sim {

// Light that falls on the sensor: red, green, blue per pixel, 0..255 and beyond.
struct Picture {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> light;  // 3 * width * height

  float* row(int v) {
    return &light[3 * static_cast<std::size_t>(v) * static_cast<std::size_t>(width_px)];
  }
  const float* row(int v) const { return const_cast<Picture*>(this)->row(v); }
};

// What the lens, the motion of the camera and the sensor make of it.
Image develop(Picture picture, const SensorOptions& sensor, std::uint64_t seed, int threads);

}  // namespace plumbline::sim
