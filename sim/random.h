// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace plumbline::sim {

// The finaliser of SplitMix64 (Steele, Lea and Flood 2014): every bit of the result depends on
// every bit of `x`. Counter-based: the noise of a pixel depends on its place, not on who came
// first.
constexpr std::uint64_t mixed(std::uint64_t x) {
  x += 0x9E3779B97F4A7C15u;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9u;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBu;
  return x ^ (x >> 31);
}

constexpr std::uint64_t mixed(std::uint64_t a, std::uint64_t b) { return mixed(mixed(a) ^ b); }

// Uniform in [-1, 1) from the upper bits of a hash.
constexpr float signed_unit(std::uint64_t hash) {
  return static_cast<float>(static_cast<std::int32_t>(hash >> 32)) * (1.0f / 2147483648.0f);
}

// Normal to the eye and to its variance (mean 0, variance 1, bounded by 3.46): the sum of four
// uniform 16-bit numbers. For noise of pixels, where millions are wanted.
constexpr float rough_normal(std::uint64_t hash) {
  const auto part = [hash](int k) {
    return static_cast<std::int32_t>((hash >> (16 * k)) & 0xFFFFu);
  };
  const std::int32_t sum = part(0) + part(1) + part(2) + part(3) - 2 * 65535;
  return static_cast<float>(sum) * (1.7320508f / 65536.0f);
}

// A sequence of random numbers: the same seed and stream give the same sequence on every machine.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t stream) : state_(mixed(seed, stream)) {}

  std::uint64_t next() { return mixed(state_ += 0x9E3779B97F4A7C15u); }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }  // [0, 1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  double normal();  // mean 0, variance 1 (Box and Muller 1958)

 private:
  std::uint64_t state_;
};

}  // namespace plumbline::sim
