// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/raw_image.h"
#include "edge/base/result.h"

namespace plumbline::pixels {

// What a raw file says of its frame beside the samples.
struct DngFacts {
  std::string camera;  // the model; profiles of raw converters go by it
  RawColour colour;
  std::optional<std::chrono::nanoseconds> exposure;
};

// A raw file (Adobe DNG 1.4) of a Bayer frame: all samples in all their bits, uncompressed, not
// interpolated. Samples of more than 8 bits stand in 16, with WhiteLevel telling how many count.
// What is not known is stated so that nothing is changed by it: a black level of 0, gains of 1. The
// colours are taken for those of sRGB (IEC 61966-2-1) once the gains are applied, in daylight: the
// sensor's own filters are in no driver's description, so colours are plausible, not calibrated.
// Errors: a frame that is no Bayer, or that check_layout() refuses. Reentrant.
Result<std::vector<std::uint8_t>> dng_of(const RawImage& frame, const DngFacts& facts);

}  // namespace plumbline::pixels
