// SPDX-License-Identifier: MIT
#include "edge/mavlink/frame_reader.h"

#include <algorithm>

#include "edge/mavlink/checksum.h"

namespace plumbline::mavlink {
namespace {

constexpr std::string_view kStartMarks = "\xFE\xFD";
constexpr std::size_t kChecksumSize = 2;
constexpr std::size_t kSignatureSize = 13;
constexpr std::uint8_t kSigned = 0x01;  // the one incompatibility flag there is

std::uint8_t byte_at(std::string_view bytes, std::size_t at) {
  return static_cast<std::uint8_t>(bytes[at]);
}

bool is_version_1(std::string_view bytes) { return bytes[0] == '\xFE'; }

std::size_t header_size(std::string_view bytes) { return is_version_1(bytes) ? 6 : 10; }

std::size_t covered_size(std::string_view bytes) { return header_size(bytes) + byte_at(bytes, 1); }

std::uint8_t incompatibility_flags(std::string_view bytes) {
  return is_version_1(bytes) ? std::uint8_t{0} : byte_at(bytes, 2);
}

bool is_signed(std::string_view bytes) { return (incompatibility_flags(bytes) & kSigned) != 0; }

// Of a frame whose header is there.
std::size_t whole_size(std::string_view bytes) {
  return covered_size(bytes) + kChecksumSize + (is_signed(bytes) ? kSignatureSize : 0);
}

std::uint32_t id_of(std::string_view bytes) {
  if (is_version_1(bytes)) return byte_at(bytes, 5);
  return byte_at(bytes, 7) | static_cast<std::uint32_t>(byte_at(bytes, 8)) << 8 |
         static_cast<std::uint32_t>(byte_at(bytes, 9)) << 16;
}

bool checksum_holds(std::string_view bytes, std::uint8_t crc_extra) {
  const std::size_t size = covered_size(bytes);
  Checksum checksum;
  checksum.add(bytes.substr(1, size - 1));
  checksum.add(crc_extra);
  return checksum.value() == (byte_at(bytes, size) | byte_at(bytes, size + 1) << 8);
}

// The low byte of a checksum before its last byte mixes with that byte: each of 256 bytes gives
// another checksum, and so 256 of 65536 checksums are possible.
bool could_hold(std::string_view bytes) {
  const std::size_t size = covered_size(bytes);
  Checksum before;
  before.add(bytes.substr(1, size - 1));
  const int given = byte_at(bytes, size) | byte_at(bytes, size + 1) << 8;
  for (int extra = 0; extra < 256; ++extra) {
    Checksum checksum = before;
    checksum.add(static_cast<std::uint8_t>(extra));
    if (checksum.value() == given) return true;
  }
  return false;
}

Frame frame_of(std::string_view bytes) {
  const std::size_t sender = is_version_1(bytes) ? 2 : 4;
  Frame frame;
  frame.version = is_version_1(bytes) ? 1 : 2;
  frame.sequence = byte_at(bytes, sender);
  frame.system_id = byte_at(bytes, sender + 1);
  frame.component_id = byte_at(bytes, sender + 2);
  frame.id = id_of(bytes);
  frame.payload = bytes.substr(header_size(bytes), byte_at(bytes, 1));
  return frame;
}

}  // namespace

void FrameReader::feed(std::string_view bytes) {
  counters_.bytes += bytes.size();
  if (pending_.empty()) {
    pending_ = bytes.substr(take_all(bytes));
    return;
  }
  pending_ += bytes;
  pending_.erase(0, take_all(pending_));
}

void FrameReader::flush() {
  while (!pending_.empty()) {
    ++counters_.bad_checksum;
    pending_.erase(0, drop_garbage(1));
    pending_.erase(0, take_all(pending_));
  }
}

void FrameReader::cut() {
  drop_garbage(pending_.size());
  pending_.clear();
}

// Returns how many bytes are done with; the rest begins a frame that is not whole yet.
std::size_t FrameReader::take_all(std::string_view bytes) {
  std::size_t done = 0;
  while (done < bytes.size()) {
    const std::size_t taken = take(bytes.substr(done));
    if (taken == 0) break;
    done += taken;
  }
  return done;
}

std::size_t FrameReader::take(std::string_view bytes) {
  const std::size_t start = std::min(bytes.find_first_of(kStartMarks), bytes.size());
  if (start > 0) return drop_garbage(start);
  if (bytes.size() < header_size(bytes) || bytes.size() < whole_size(bytes)) return 0;
  return take_whole(bytes.substr(0, whole_size(bytes)));
}

std::size_t FrameReader::take_whole(std::string_view bytes) {
  const Definition* definition = find_definition(id_of(bytes));
  const bool holds =
      definition != nullptr ? checksum_holds(bytes, definition->crc_extra) : could_hold(bytes);
  if (!holds) {
    ++counters_.bad_checksum;
    return drop_garbage(1);
  }
  if (definition == nullptr) {
    ++counters_.unknown;
  } else {
    hand_on(bytes, *definition);
  }
  return bytes.size();
}

std::size_t FrameReader::drop_garbage(std::size_t count) {
  counters_.garbage_bytes += count;
  return count;
}

void FrameReader::hand_on(std::string_view bytes, const Definition& definition) {
  ++counters_.frames;
  if (is_signed(bytes)) ++counters_.signed_frames;
  if ((incompatibility_flags(bytes) & ~kSigned) != 0) {
    ++counters_.incompatible;  // the protocol's rule: whoever does not know the flag drops it
    return;
  }
  Frame frame = frame_of(bytes);
  if (frame.version == 1 && frame.payload.size() < definition.length_v1) {
    ++counters_.malformed;
    return;
  }
  frame.payload.resize(std::max(frame.payload.size(), definition.length_full));
  sink_(frame);
}

}  // namespace plumbline::mavlink
