// SPDX-License-Identifier: MIT
#include "edge/record/journal.h"

#include <zlib.h>

#include <utility>

#include "edge/record/packing.h"

namespace plumbline::record {
namespace {

constexpr std::string_view kMagic = "PLUMBJRN";
constexpr std::size_t kHeadSize = 16;
constexpr std::uint32_t kMark = 0x4C50'B5E7;  // of a frame: e7 b5 50 4c
constexpr std::string_view kMarkBegins = "\xE7\xB5\x50";
constexpr std::size_t kFrameSize = 24;  // before the payload
constexpr std::uint32_t kLongestPayload = 16u << 20;

std::uint32_t crc_of(std::string_view a, std::string_view b = {}) {
  const auto fed = [](uLong crc, std::string_view bytes) {
    if (bytes.empty()) return crc;  // zlib begins anew where there is no pointer
    return crc32(crc, reinterpret_cast<const Bytef*>(bytes.data()),
                 static_cast<uInt>(bytes.size()));
  };
  return static_cast<std::uint32_t>(fed(fed(crc32(0, nullptr, 0), a), b));
}

// No mark stands in a payload: whatever a device sends, be it another journal, a reader that looks
// for the next entry cannot take a part of this one for it.
void stuff(std::string& out, std::size_t payload_begin) {
  std::size_t place = out.find(kMarkBegins, payload_begin);
  while (place != std::string::npos) {
    place += kMarkBegins.size();
    out.insert(place, 1, '\0');
    place = out.find(kMarkBegins, place);
  }
}

// Nothing where the bytes were not written by stuff().
std::optional<std::string> unstuffed(std::string_view bytes) {
  std::string payload;
  payload.reserve(bytes.size());
  for (;;) {
    const std::size_t place = bytes.find(kMarkBegins);
    if (place == std::string_view::npos) break;
    const std::size_t end = place + kMarkBegins.size();
    if (end == bytes.size() || bytes[end] != '\0') return std::nullopt;
    payload.append(bytes.substr(0, end));
    bytes.remove_prefix(end + 1);
  }
  payload.append(bytes);
  return payload;
}

}  // namespace

std::string journal_head() {
  std::string head(kMagic);
  Packer to(head);
  to.put(kFormatVersion);
  to.put(crc_of(head));
  return head;
}

// mark, payload length, sequence, kind, 0, CRC of all that but itself.
void append_entry(const Entry& entry, std::uint64_t sequence, std::string& out) {
  const std::size_t begin = out.size();
  Packer to(out);
  to.put(kMark);
  to.put(std::uint32_t{0});
  to.put(sequence);
  to.put(kind_of(entry));
  to.put(std::uint16_t{0});
  to.put(std::uint32_t{0});
  pack(entry, out);
  stuff(out, begin + kFrameSize);
  const std::size_t length = out.size() - begin - kFrameSize;
  const auto write_at = [&](std::size_t place, std::uint32_t value) {
    for (std::size_t k = 0; k < 4; ++k) out[place + k] = static_cast<char>(value >> (8 * k));
  };
  write_at(begin + 4, static_cast<std::uint32_t>(length));
  const std::string_view whole(out);
  write_at(begin + 20, crc_of(whole.substr(begin, 20), whole.substr(begin + kFrameSize)));
}

Result<JournalReader> JournalReader::over(std::string_view bytes) {
  if (!bytes.starts_with(kMagic.substr(0, std::min(bytes.size(), kMagic.size())))) {
    return Error{"This is not a flight journal: it does not begin with PLUMBJRN."};
  }
  JournalReader reader(bytes);
  if (bytes.size() < kHeadSize) {  // cut in its very beginning
    reader.place_ = bytes.size();
    return reader;
  }
  Unpacker head(bytes.substr(kMagic.size()));
  const auto version = head.get<std::uint32_t>();
  const auto crc = head.get<std::uint32_t>();
  const bool whole = crc == crc_of(bytes.substr(0, kHeadSize - 4)) ||
                     (crc == 0 && version == kFormatVersion);  // as the first programs wrote it
  if (whole && version != kFormatVersion) {
    return Error{"The journal is of format " + std::to_string(version) + ", this program reads " +
                 std::to_string(kFormatVersion) + ": use the version that wrote it."};
  }
  reader.place_ = kHeadSize;
  reader.summary_.whole_bytes = whole ? kHeadSize : 0;
  if (!whole) reader.summary_.skipped_bytes = kHeadSize;
  return reader;
}

std::optional<JournalReader::Found> JournalReader::frame_at(std::size_t place) const {
  if (bytes_.size() - place < kFrameSize) return std::nullopt;
  Unpacker from(bytes_.substr(place, kFrameSize));
  if (from.get<std::uint32_t>() != kMark) return std::nullopt;
  const auto length = from.get<std::uint32_t>();
  Found found;
  found.sequence = from.get<std::uint64_t>();
  found.kind = from.get<std::uint16_t>();
  const auto reserved = from.get<std::uint16_t>();
  const auto crc = from.get<std::uint32_t>();
  if (length > kLongestPayload || length > bytes_.size() - place - kFrameSize) return std::nullopt;
  const auto stuffed = bytes_.substr(place + kFrameSize, length);
  if (reserved != 0 || crc != crc_of(bytes_.substr(place, 20), stuffed)) return std::nullopt;
  auto payload = unstuffed(stuffed);
  if (!payload) return std::nullopt;
  found.payload = std::move(*payload);
  found.begin = place;
  found.end = place + kFrameSize + length;
  return found;
}

std::optional<JournalReader::Found> JournalReader::next_frame() {
  static constexpr char kFirst = static_cast<char>(kMark & 0xFF);
  for (std::size_t place = place_; place < bytes_.size(); ++place) {
    place = bytes_.find(kFirst, place);
    if (place == std::string_view::npos) break;
    if (auto found = frame_at(place)) return found;
  }
  return std::nullopt;
}

void JournalReader::account(const Found& found) {
  const bool follows = found.begin == place_ && found.sequence == summary_.next_sequence;
  summary_.skipped_bytes += found.begin - place_;
  if (found.sequence > summary_.next_sequence) {
    summary_.lost_entries += found.sequence - summary_.next_sequence;
  }
  if (!follows && summary_.skipped_bytes == 0) ++summary_.skipped_bytes;  // out of order
  summary_.next_sequence = found.sequence + 1;
  ++summary_.entries;
  place_ = found.end;
  if (summary_.skipped_bytes == 0) summary_.whole_bytes = place_;
}

std::optional<Entry> JournalReader::next() {
  while (const auto found = next_frame()) {
    account(*found);
    auto entry = unpack(found->kind, found->payload);
    ended_ = entry && std::holds_alternative<Ended>(*entry);
    if (entry) return std::move(*entry);
    ++summary_.unknown;
  }
  return std::nullopt;
}

JournalSummary JournalReader::summary() const {
  JournalSummary summary = summary_;
  summary.tail_bytes = bytes_.size() - place_;
  const bool whole = summary.tail_bytes == 0 && ended_;
  summary.state = summary.skipped_bytes > 0 ? JournalState::kDamaged
                  : whole                   ? JournalState::kComplete
                                            : JournalState::kTruncated;
  return summary;
}

}  // namespace plumbline::record
