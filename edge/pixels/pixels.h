// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <vector>

#include "edge/base/image.h"
#include "edge/base/raw_image.h"
#include "edge/base/result.h"

namespace plumbline::pixels {

// A camera's frame as the rest of the program wants it. Errors: a frame that is cut short, of an
// impossible size, or a damaged JPEG; never an image with pixels that were not there. Reentrant.
//
// Y'CbCr is BT.601's, in the range that the frame states; out come always 0 to 255. What a camera
// writes outside of the limited range (footroom below 16, headroom above 235) is clipped.
// Bayer is interpolated bilinearly, borders by mirroring; samples stay linear in light and without
// white balance; of more than 8 bits the upper 8 are kept.

// One channel. Of YUYV, NV12 and MJPEG this is Y, made from no other channel; else JPEG's weights:
// 0.299 red + 0.587 green + 0.114 blue.
Result<Image> grey_of(const RawImage& frame);

// Three channels; grey frames three times the same.
Result<Image> rgb_of(const RawImage& frame);

// A JPEG file. MJPEG passes through (`quality` is the camera's own) once it has been read to its
// end, with the tables put in that cameras leave out (edge/jpeg/huffman_tables.h); YUYV and NV12
// are written with their own Y and colours, at their own sampling. Quality 1..100 in libjpeg's
// sense.
Result<std::vector<std::uint8_t>> jpeg_of(const RawImage& frame, int quality);

}  // namespace plumbline::pixels
