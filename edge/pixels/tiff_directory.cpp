// SPDX-License-Identifier: MIT
#include "edge/pixels/tiff_directory.h"

#include <cmath>
#include <cstddef>

namespace plumbline::pixels {
namespace {

using Bytes = std::vector<std::uint8_t>;

// TIFF 6.0, section 2: the types of values.
constexpr std::uint16_t kByte = 1;
constexpr std::uint16_t kAscii = 2;
constexpr std::uint16_t kShort = 3;
constexpr std::uint16_t kLong = 4;
constexpr std::uint16_t kRational = 5;
constexpr std::uint16_t kSignedRational = 10;

constexpr std::uint16_t kStripOffsets = 273;
constexpr std::uint16_t kStripByteCounts = 279;

constexpr std::size_t kHeaderBytes = 8;
constexpr std::size_t kEntryBytes = 12;
constexpr std::size_t kInEntryBytes = 4;  // longer values lie behind the directory

void put_short(std::uint16_t value, Bytes& to) {
  to.push_back(static_cast<std::uint8_t>(value));
  to.push_back(static_cast<std::uint8_t>(value >> 8));
}

void put_long(std::uint32_t value, Bytes& to) {
  put_short(static_cast<std::uint16_t>(value), to);
  put_short(static_cast<std::uint16_t>(value >> 16), to);
}

std::size_t even(std::size_t bytes) { return bytes + bytes % 2; }

Bytes ratios(const std::vector<double>& values) {
  Bytes bytes;
  for (const double value : values) {
    const std::uint32_t parts = std::abs(value) < 2000 ? 1'000'000 : 10'000;
    put_long(static_cast<std::uint32_t>(std::llround(value * parts)), bytes);
    put_long(parts, bytes);
  }
  return bytes;
}

}  // namespace

void TiffDirectory::set_bytes(std::uint16_t tag, std::vector<std::uint8_t> values) {
  const auto count = static_cast<std::uint32_t>(values.size());
  entries_[tag] = {kByte, count, std::move(values)};
}

void TiffDirectory::set_text(std::uint16_t tag, const std::string& text) {
  const char* begin = text.c_str();
  Bytes bytes(begin, begin + std::string(begin).size() + 1);
  const auto count = static_cast<std::uint32_t>(bytes.size());
  entries_[tag] = {kAscii, count, std::move(bytes)};
}

void TiffDirectory::set_shorts(std::uint16_t tag, const std::vector<std::uint16_t>& values) {
  Bytes bytes;
  for (const std::uint16_t value : values) put_short(value, bytes);
  entries_[tag] = {kShort, static_cast<std::uint32_t>(values.size()), std::move(bytes)};
}

void TiffDirectory::set_longs(std::uint16_t tag, const std::vector<std::uint32_t>& values) {
  Bytes bytes;
  for (const std::uint32_t value : values) put_long(value, bytes);
  entries_[tag] = {kLong, static_cast<std::uint32_t>(values.size()), std::move(bytes)};
}

void TiffDirectory::set_ratios(std::uint16_t tag, const std::vector<double>& values) {
  entries_[tag] = {kRational, static_cast<std::uint32_t>(values.size()), ratios(values)};
}

void TiffDirectory::set_signed_ratios(std::uint16_t tag, const std::vector<double>& values) {
  entries_[tag] = {kSignedRational, static_cast<std::uint32_t>(values.size()), ratios(values)};
}

Bytes TiffDirectory::file_with(Bytes pixels) const {
  TiffDirectory all = *this;
  all.set_longs(kStripByteCounts, {static_cast<std::uint32_t>(pixels.size())});
  all.set_longs(kStripOffsets, {0});
  std::size_t behind = kHeaderBytes + 2 + all.entries_.size() * kEntryBytes + 4;
  std::size_t strip = behind;
  for (const auto& [tag, entry] : all.entries_) {
    if (entry.bytes.size() > kInEntryBytes) strip += even(entry.bytes.size());
  }
  all.set_longs(kStripOffsets, {static_cast<std::uint32_t>(strip)});

  Bytes file = {'I', 'I', 42, 0, kHeaderBytes, 0, 0, 0};
  Bytes values;
  put_short(static_cast<std::uint16_t>(all.entries_.size()), file);
  for (auto& [tag, entry] : all.entries_) {
    put_short(tag, file);
    put_short(entry.type, file);
    put_long(entry.count, file);
    Bytes& where = entry.bytes.size() > kInEntryBytes ? values : file;
    if (&where == &values) put_long(static_cast<std::uint32_t>(behind + values.size()), file);
    where.insert(where.end(), entry.bytes.begin(), entry.bytes.end());
    const std::size_t full = &where == &values ? even(entry.bytes.size()) : kInEntryBytes;
    where.resize(where.size() + full - entry.bytes.size());
  }
  put_long(0, file);  // no further directory
  file.insert(file.end(), values.begin(), values.end());
  file.insert(file.end(), pixels.begin(), pixels.end());
  return file;
}

}  // namespace plumbline::pixels
