// SPDX-License-Identifier: MIT
#include "edge/base/pixel_format.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <vector>

namespace plumbline {
namespace {

struct Known {
  PixelFormat format;
  const char* name;
  BayerLayout bayer;  // of Bayer formats
};

constexpr std::array<Known, 29> kKnown = {{
    {PixelFormat::kGrey, "GREY", {}},
    {PixelFormat::kYuyv, "YUYV", {}},
    {PixelFormat::kNv12, "NV12", {}},
    {PixelFormat::kMjpeg, "MJPG", {}},
    {PixelFormat::kRgb24, "RGB3", {}},
    {PixelFormat::kRggb8, "RGGB", {BayerOrder::kRggb, 8, false}},
    {PixelFormat::kGrbg8, "GRBG", {BayerOrder::kGrbg, 8, false}},
    {PixelFormat::kGbrg8, "GBRG", {BayerOrder::kGbrg, 8, false}},
    {PixelFormat::kBggr8, "BA81", {BayerOrder::kBggr, 8, false}},
    {PixelFormat::kRggb10, "RG10", {BayerOrder::kRggb, 10, false}},
    {PixelFormat::kGrbg10, "BA10", {BayerOrder::kGrbg, 10, false}},
    {PixelFormat::kGbrg10, "GB10", {BayerOrder::kGbrg, 10, false}},
    {PixelFormat::kBggr10, "BG10", {BayerOrder::kBggr, 10, false}},
    {PixelFormat::kRggb10Packed, "pRAA", {BayerOrder::kRggb, 10, true}},
    {PixelFormat::kGrbg10Packed, "pgAA", {BayerOrder::kGrbg, 10, true}},
    {PixelFormat::kGbrg10Packed, "pGAA", {BayerOrder::kGbrg, 10, true}},
    {PixelFormat::kBggr10Packed, "pBAA", {BayerOrder::kBggr, 10, true}},
    {PixelFormat::kRggb12, "RG12", {BayerOrder::kRggb, 12, false}},
    {PixelFormat::kGrbg12, "BA12", {BayerOrder::kGrbg, 12, false}},
    {PixelFormat::kGbrg12, "GB12", {BayerOrder::kGbrg, 12, false}},
    {PixelFormat::kBggr12, "BG12", {BayerOrder::kBggr, 12, false}},
    {PixelFormat::kRggb12Packed, "pRCC", {BayerOrder::kRggb, 12, true}},
    {PixelFormat::kGrbg12Packed, "pgCC", {BayerOrder::kGrbg, 12, true}},
    {PixelFormat::kGbrg12Packed, "pGCC", {BayerOrder::kGbrg, 12, true}},
    {PixelFormat::kBggr12Packed, "pBCC", {BayerOrder::kBggr, 12, true}},
    {PixelFormat::kRggb16, "RG16", {BayerOrder::kRggb, 16, false}},
    {PixelFormat::kGrbg16, "GR16", {BayerOrder::kGrbg, 16, false}},
    {PixelFormat::kGbrg16, "GB16", {BayerOrder::kGbrg, 16, false}},
    {PixelFormat::kBggr16, "BYR2", {BayerOrder::kBggr, 16, false}},
}};

std::string long_name_of(const BayerLayout& bayer) {
  constexpr std::array<const char*, 4> kOrders = {"RGGB", "GRBG", "GBRG", "BGGR"};
  return "S" + std::string(kOrders[static_cast<std::size_t>(bayer.order)]) +
         std::to_string(bayer.bits) + (bayer.packed ? "P" : "");
}

bool same_letters(const std::string& a, const std::string& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](unsigned char x, unsigned char y) {
    return std::toupper(x) == std::toupper(y);
  });
}

bool has_long_name(const Known& known, const std::string& name) {
  const auto bayer = bayer_of(known.format);
  return bayer && same_letters(name, long_name_of(*bayer));
}

std::size_t packed_row_bytes(int bits, std::size_t width) {
  return bits == 10 ? (width + 3) / 4 * 5 : (width + 1) / 2 * 3;
}

}  // namespace

std::optional<BayerLayout> bayer_of(PixelFormat format) {
  if (format < PixelFormat::kRggb8) return std::nullopt;
  for (const Known& known : kKnown) {
    if (known.format == format) return known.bayer;
  }
  return std::nullopt;
}

std::string name_of(PixelFormat format) {
  for (const Known& known : kKnown) {
    if (known.format == format) return known.name;
  }
  return "unknown";
}

std::uint32_t code_of(PixelFormat format) {
  const std::string name = name_of(format);
  std::uint32_t code = 0;
  for (std::size_t i = 4; i-- > 0;) code = code << 8 | static_cast<unsigned char>(name[i]);
  return code;
}

std::optional<PixelFormat> pixel_format_of_code(std::uint32_t code) {
  for (const Known& known : kKnown) {
    if (code_of(known.format) == code) return known.format;
  }
  return std::nullopt;
}

Result<PixelFormat> pixel_format_of(const std::string& name) {
  std::vector<PixelFormat> alike;
  for (const Known& known : kKnown) {
    if (name == known.name) return known.format;
    if (same_letters(name, known.name) || has_long_name(known, name)) alike.push_back(known.format);
  }
  if (alike.size() == 1) return alike.front();
  if (alike.size() > 1) {
    return Error{"'" + name + "' could be pixel format " + name_of(alike[0]) + " or " +
                 name_of(alike[1]) + "; write it in just these letters."};
  }
  return Error{"There is no pixel format '" + name + "'; there are " + pixel_format_names() + "."};
}

std::string pixel_format_names() {
  std::string names;
  for (const Known& known : kKnown) {
    if (!bayer_of(known.format)) names += std::string(known.name) + ", ";
  }
  return names +
         "and of Bayer SRGGB8, SRGGB10, SRGGB10P (packed), SRGGB12, SRGGB12P, SRGGB16, the same "
         "with GRBG, GBRG, BGGR, and V4L2's short names of them (RG10, pRAA)";
}

std::size_t row_bytes(PixelFormat format, int width_px) {
  const auto width = static_cast<std::size_t>(width_px);
  if (const auto bayer = bayer_of(format)) {
    if (bayer->packed) return packed_row_bytes(bayer->bits, width);
    return bayer->bits == 8 ? width : 2 * width;
  }
  if (format == PixelFormat::kYuyv) return 2 * width;
  if (format == PixelFormat::kRgb24) return 3 * width;
  return format == PixelFormat::kMjpeg ? 0 : width;
}

}  // namespace plumbline
