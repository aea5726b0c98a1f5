// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>

namespace plumbline::hil {

// The middle of a frame's exposure, in nanoseconds of the host's monotonic clock, in its own first
// row: what the camera cannot say and a test must know. A bit in each pair of pixels of YUY2,
// lowest first, black or white; then the complement, by which a damaged mark shows.
constexpr std::size_t kMarkBits = 64;
constexpr std::size_t kMarkBytes = 2 * kMarkBits * 4;

// `yuy2`: a row of 256 pixels or more at its beginning.
inline void write_exposure_mark(std::string& yuy2, std::uint64_t middle_ns) {
  for (std::size_t bit = 0; bit < 2 * kMarkBits; ++bit) {
    const bool set = (middle_ns >> (bit % kMarkBits) & 1) != 0;
    const char luma = set == (bit < kMarkBits) ? '\xff' : '\0';
    yuy2[4 * bit] = yuy2[4 * bit + 2] = luma;
  }
}

// Empty where there is no sound mark.
inline std::optional<std::uint64_t> read_exposure_mark(std::span<const std::uint8_t> yuy2) {
  if (yuy2.size() < kMarkBytes) return std::nullopt;
  std::uint64_t value = 0, complement = 0;
  for (std::size_t bit = 0; bit < kMarkBits; ++bit) {
    value |= static_cast<std::uint64_t>(yuy2[4 * bit] >> 7) << bit;
    complement |= static_cast<std::uint64_t>(yuy2[4 * (bit + kMarkBits)] >> 7) << bit;
  }
  if (value != ~complement) return std::nullopt;
  return value;
}

}  // namespace plumbline::hil
