// SPDX-License-Identifier: MIT
#include "edge/pixels/pixels.h"

#include <cstddef>
#include <cstring>
#include <string>

#include "edge/jpeg/huffman_tables.h"
#include "edge/jpeg/jpeg.h"
#include "edge/pixels/bayer.h"
#include "edge/pixels/luma_chroma.h"

namespace plumbline::pixels {
namespace {

const std::string kFrameName = "frame of the camera";

Image blank(const RawImage& frame, int channels) {
  Image image{frame.width_px, frame.height_px, channels, {}};
  image.data.resize(static_cast<std::size_t>(frame.width_px) *
                    static_cast<std::size_t>(frame.height_px) * static_cast<std::size_t>(channels));
  return image;
}

bool has_luma(PixelFormat format) {
  return format == PixelFormat::kYuyv || format == PixelFormat::kNv12;
}

// Takes away the padding of the rows.
Image packed(const RawImage& frame, int channels) {
  Image image = blank(frame, channels);
  const std::size_t row = row_bytes(frame.format, frame.width_px);
  for (int v = 0; v < frame.height_px; ++v) {
    std::memcpy(image.data.data() + image.index(0, v),
                frame.bytes.data() + static_cast<std::size_t>(v) * frame.stride_bytes, row);
  }
  return image;
}

// The weights of JFIF, as libjpeg rounds them.
Image grey_of_rgb(const Image& rgb) {
  Image grey{rgb.width_px, rgb.height_px, 1, {}};
  grey.data.resize(rgb.data.size() / 3);
  const std::uint8_t* from = rgb.data.data();
  for (std::uint8_t& pixel : grey.data) {
    pixel = static_cast<std::uint8_t>(
        (19595 * from[0] + 38470 * from[1] + 7471 * from[2] + (1 << 15)) >> 16);
    from += 3;
  }
  return grey;
}

Image rgb_of_grey(const Image& grey) {
  Image rgb{grey.width_px, grey.height_px, 3, {}};
  rgb.data.reserve(3 * grey.data.size());
  for (const std::uint8_t pixel : grey.data) rgb.data.insert(rgb.data.end(), 3, pixel);
  return rgb;
}

// A JPEG says its size itself: it must be that of the stream.
Result<Image> of_stream_size(Result<Image> image, const RawImage& frame) {
  if (!image) return image;
  if (image->width_px == frame.width_px && image->height_px == frame.height_px) return image;
  return Error{"A camera frame is a JPEG of " + std::to_string(image->width_px) + " x " +
               std::to_string(image->height_px) + " in a stream of " +
               std::to_string(frame.width_px) + " x " + std::to_string(frame.height_px) + "."};
}

Image luma_image(const RawImage& frame) {
  const LumaChroma rows(frame);
  Image grey = blank(frame, 1);
  for (int v = 0; v < frame.height_px; ++v) rows.luma_row(v, grey.data.data() + grey.index(0, v));
  return grey;
}

Image colour_image(const RawImage& frame) {
  const LumaChroma rows(frame);
  Image rgb = blank(frame, 3);
  for (int v = 0; v < frame.height_px; ++v) rows.rgb_row(v, rgb.data.data() + rgb.index(0, v));
  return rgb;
}

Image colour_of_bayer(const RawImage& frame) {
  const BayerLayout layout = bayer_of(frame.format).value();
  return demosaic(bayer_samples(frame, layout), layout.order);
}

std::vector<std::uint8_t> encode_luma_chroma(const RawImage& frame, int quality) {
  const LumaChroma rows(frame);
  const auto sampling = frame.format == PixelFormat::kYuyv ? jpeg::ChromaSampling::kHalfWidth
                                                           : jpeg::ChromaSampling::kHalfBoth;
  return jpeg::encode_ycbcr({frame.width_px, frame.height_px, 3}, sampling, quality,
                            [&rows](int v, std::uint8_t* row) { rows.ycbcr_row(v, row); });
}

}  // namespace

Result<Image> grey_of(const RawImage& frame) {
  if (const Status layout = check_layout(frame); !layout) return layout.error();
  if (has_luma(frame.format)) return luma_image(frame);
  if (frame.format == PixelFormat::kGrey) return packed(frame, 1);
  if (frame.format == PixelFormat::kMjpeg) {
    return of_stream_size(jpeg::decode_grey(frame.bytes, kFrameName), frame);
  }
  if (frame.format == PixelFormat::kRgb24) return grey_of_rgb(packed(frame, 3));
  return grey_of_rgb(colour_of_bayer(frame));
}

Result<Image> rgb_of(const RawImage& frame) {
  if (const Status layout = check_layout(frame); !layout) return layout.error();
  if (has_luma(frame.format)) return colour_image(frame);
  if (frame.format == PixelFormat::kGrey) return rgb_of_grey(packed(frame, 1));
  if (frame.format == PixelFormat::kMjpeg) {
    return of_stream_size(jpeg::decode_rgb(frame.bytes, kFrameName), frame);
  }
  if (frame.format == PixelFormat::kRgb24) return packed(frame, 3);
  return colour_of_bayer(frame);
}

Result<std::vector<std::uint8_t>> jpeg_of(const RawImage& frame, int quality) {
  if (const Status layout = check_layout(frame); !layout) return layout.error();
  if (has_luma(frame.format)) return encode_luma_chroma(frame, quality);
  if (frame.format == PixelFormat::kGrey) return jpeg::encode(packed(frame, 1), quality);
  if (frame.format == PixelFormat::kMjpeg) {
    if (const auto sound = grey_of(frame); !sound) return sound.error();
    return jpeg::with_huffman_tables(frame.bytes);
  }
  const Result<Image> rgb = rgb_of(frame);
  if (!rgb) return rgb.error();
  return jpeg::encode(*rgb, quality);
}

}  // namespace plumbline::pixels
