// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "edge/base/image.h"
#include "edge/base/result.h"

namespace plumbline::jpeg {

// JPEG bytes to pixels and back, over libjpeg-turbo. What libjpeg merely warns of (a stream cut
// short, corrupt entropy data) is an error here, because it would otherwise become grey areas that
// look measured. Tolerated: bytes after the end-of-image marker (cameras append previews there),
// stray bytes between header segments, and a few padding bytes before the end-of-image marker.
// Pixels are as stored: an EXIF orientation is not applied, for it is not a property of the lens.
// `name` is the photo's name for the sentence of an error. Reentrant.

struct JpegHeader {
  int width_px = 0;
  int height_px = 0;
  int channels = 0;  // as stored: 1 grey, 3 colour
};

// The largest photo accepted, in pixels (the largest aerial cameras of today have 150 million).
inline constexpr std::int64_t kMaxPixels = 250'000'000;

Result<JpegHeader> read_header(std::span<const std::uint8_t> bytes, const std::string& name);

// One channel: the luminance of a colour photo, undone from no other channel.
Result<Image> decode_grey(std::span<const std::uint8_t> bytes, const std::string& name);

// Three channels: red, green, blue.
Result<Image> decode_rgb(std::span<const std::uint8_t> bytes, const std::string& name);

// `image` has 1 or 3 channels and a size of 1..65500 px a side (anything else is a broken
// invariant); quality 1..100 in libjpeg's sense. The same image gives the same bytes.
std::vector<std::uint8_t> encode(const Image& image, int quality);

// How many of the colour samples a JPEG keeps.
enum class ChromaSampling { kHalfWidth, kHalfBoth };  // 4:2:2, 4:2:0

// Writes row v of the image as Y Cb Cr of each pixel, in full range.
using YcbcrRows = std::function<void(int v, std::uint8_t* row)>;

// Encodes what a camera delivers as Y'CbCr without a detour through red, green and blue. Colours
// that are the same in all pixels of a sample lose nothing to sampling. Size and quality as above.
std::vector<std::uint8_t> encode_ycbcr(const JpegHeader& size, ChromaSampling sampling, int quality,
                                       const YcbcrRows& rows);

}  // namespace plumbline::jpeg
