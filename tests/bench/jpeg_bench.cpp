// SPDX-License-Identifier: MIT
// Decoding a 12-megapixel photo beside copying the pixels it becomes, in the same run.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "edge/jpeg/jpeg.h"

namespace plumbline::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

// Waves of many lengths and a little grain: as hard to code as ground.
Image ground_like() {
  Image image{4000, 3000, 3, std::vector<std::uint8_t>(std::size_t{4000} * 3000 * 3)};
  std::uint32_t grain = 1;
  for (int v = 0; v < image.height_px; ++v) {
    for (int u = 0; u < image.width_px; ++u) {
      grain = grain * 1664525U + 1013904223U;
      const double wave = std::sin(u * 0.03) + std::sin(v * 0.11) + std::sin((u + v) * 0.4);
      const auto grey = static_cast<std::uint8_t>(120 + 30 * wave + (grain >> 28U));
      for (std::size_t c = 0; c < 3; ++c) image.data[image.index(u, v) + c] = grey;
    }
  }
  return image;
}

void DecodeGreyBesideCopying(benchmark::State& run) {
  const std::vector<std::uint8_t> bytes = jpeg::encode(ground_like(), 90);
  double decode_s = 0;
  double copy_s = 0;
  for ([[maybe_unused]] auto _ : run) {
    Clock::time_point start = Clock::now();
    auto photo = jpeg::decode_grey(bytes, "made.jpg");
    decode_s += seconds_since(start);
    if (!photo) {
      run.SkipWithError("the photo could not be decoded");
      break;
    }
    start = Clock::now();
    std::vector<std::uint8_t> copy = photo->data;
    benchmark::DoNotOptimize(copy.data());
    copy_s += seconds_since(start);
  }
  run.counters["decode_over_copy"] = decode_s / copy_s;
}
BENCHMARK(DecodeGreyBesideCopying)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumbline::bench

BENCHMARK_MAIN();
