// SPDX-License-Identifier: MIT
#include "edge/base/raw_image.h"

#include <string>

namespace plumbline {
namespace {

std::string shown(const RawImage& image) {
  return std::to_string(image.width_px) + " x " + std::to_string(image.height_px) + " " +
         name_of(image.format);
}

// Rows of the last one only as many bytes as pixels need: drivers may leave out its padding.
std::size_t plane_bytes(std::size_t stride, std::size_t rows, std::size_t row) {
  return rows == 0 ? 0 : stride * (rows - 1) + row;
}

Status check_size(const RawImage& image) {
  constexpr int kMostPx = 65500;  // JPEG's limit; keeps all products far from overflow
  const bool possible = image.width_px > 0 && image.height_px > 0 && image.width_px <= kMostPx &&
                        image.height_px <= kMostPx;
  if (!possible) return Error{"A camera frame of " + shown(image) + " is not possible."};
  const bool odd_width = image.width_px % 2 != 0;
  const bool odd_height = image.height_px % 2 != 0;
  const bool pairs = image.format == PixelFormat::kYuyv || image.format == PixelFormat::kNv12;
  const bool squares = bayer_of(image.format).has_value() || image.format == PixelFormat::kNv12;
  if ((pairs && odd_width) || (squares && (odd_width || odd_height))) {
    return Error{"A camera frame of " + shown(image) +
                 " has an odd size, which this format cannot have; choose an even one."};
  }
  return Done{};
}

std::size_t needed_bytes(const RawImage& image, std::size_t row) {
  const auto rows = static_cast<std::size_t>(image.height_px);
  if (image.format != PixelFormat::kNv12) return plane_bytes(image.stride_bytes, rows, row);
  return image.second_plane_offset + plane_bytes(image.stride_bytes, rows / 2, row);
}

Status check_jpeg(const RawImage& image) {
  const auto bytes = image.bytes;
  const bool begins = bytes.size() > 4 && bytes[0] == 0xFF && bytes[1] == 0xD8;
  if (!begins) return Error{"A camera frame is not the JPEG that it should be."};
  // Cameras fill up with zeros after the end marker FF D9, a few bytes or to the buffer's size.
  std::size_t end = bytes.size();
  while (end > 4 && bytes[end - 1] == 0) --end;
  if (bytes[end - 2] == 0xFF && bytes[end - 1] == 0xD9) return Done{};
  return Error{"A camera frame is a JPEG without an end (" + std::to_string(bytes.size()) +
               " bytes): it was cut on its way."};
}

}  // namespace

Status check_layout(const RawImage& image) {
  if (const Status size = check_size(image); !size) return size;
  if (image.format == PixelFormat::kMjpeg) return check_jpeg(image);
  const std::size_t row = row_bytes(image.format, image.width_px);
  if (image.stride_bytes < row) {
    return Error{"A camera frame of " + shown(image) + " claims rows of " +
                 std::to_string(image.stride_bytes) + " bytes, and needs " + std::to_string(row) +
                 "."};
  }
  const auto rows = static_cast<std::size_t>(image.height_px);
  const bool overlap = image.format == PixelFormat::kNv12 &&
                       image.second_plane_offset < plane_bytes(image.stride_bytes, rows, row);
  if (overlap) {
    return Error{"A camera frame of " + shown(image) + " claims colours that overlap its grey."};
  }
  const std::size_t needed = needed_bytes(image, row);
  if (image.bytes.size() >= needed) return Done{};
  return Error{"A camera frame of " + shown(image) + " is cut short: " +
               std::to_string(image.bytes.size()) + " of " + std::to_string(needed) + " bytes."};
}

}  // namespace plumbline
