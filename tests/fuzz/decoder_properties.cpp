// SPDX-License-Identifier: MIT
#include "tests/fuzz/decoder_properties.h"

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <vector>

#include "edge/gnss/stream_decoder.h"

namespace plumbline::fuzz {
namespace {

struct Decoded {
  std::vector<GnssFix> fixes;
  std::vector<ByteRange> bytes;
  DecoderCounters counters;
};

void require(bool holds, const char* promise) {
  if (holds) return;
  std::fprintf(stderr, "broken: %s\n", promise);
  std::abort();
}

// In pieces of `piece` bytes, and cut after `cut` bytes.
Decoded decode(std::string_view bytes, std::size_t piece, std::size_t cut) {
  Decoded decoded;
  const auto decoder = gnss::make_fix_decoder([&](const GnssFix& fix, ByteRange range) {
    decoded.fixes.push_back(fix);
    decoded.bytes.push_back(range);
  });
  for (std::string_view part : {bytes.substr(0, cut), bytes.substr(cut)}) {
    for (; !part.empty(); part.remove_prefix(std::min(piece, part.size()))) {
      decoder->feed(part.substr(0, piece));
    }
    decoder->cut();
  }
  decoded.counters = decoder->counters();
  return decoded;
}

bool same(const GnssFix& a, const GnssFix& b) {
  return a.time == b.time && a.time_of_day == b.time_of_day && a.quality == b.quality &&
         a.latitude_deg == b.latitude_deg && a.longitude_deg == b.longitude_deg &&
         a.height_ellipsoidal_m == b.height_ellipsoidal_m && a.altitude_m == b.altitude_m &&
         a.covariance_enu_m2 == b.covariance_enu_m2 && a.satellites == b.satellites &&
         a.correction_age_s == b.correction_age_s;
}

void require_same(const Decoded& a, const Decoded& b, const char* promise) {
  require(a.fixes.size() == b.fixes.size(), promise);
  for (std::size_t i = 0; i < a.fixes.size(); ++i) {
    require(same(a.fixes[i], b.fixes[i]), promise);
    require(a.bytes[i].begin == b.bytes[i].begin && a.bytes[i].end == b.bytes[i].end, promise);
  }
  require(a.counters.sentences == b.counters.sentences, promise);
  require(a.counters.bad_checksum == b.counters.bad_checksum, promise);
  require(a.counters.malformed == b.counters.malformed, promise);
}

bool is_number_within(const std::optional<double>& value, double limit) {
  return !value || std::abs(*value) <= limit;
}

void require_sane(const GnssFix& fix) {
  require(is_number_within(fix.latitude_deg, 90), "latitudes end at the poles");
  require(is_number_within(fix.longitude_deg, 360), "longitudes end after one turn");
  require(fix.latitude_deg.has_value() == fix.longitude_deg.has_value(), "a position is both");
  require(is_number_within(fix.height_ellipsoidal_m, 1e24), "a height is a number");
  require(is_number_within(fix.correction_age_s, 1e24), "an age is a number");
  require(fix.quality != FixQuality::kNone || !fix.latitude_deg, "no fix, no position");
  require(!fix.satellites || *fix.satellites >= 0, "satellites are counted");
  const auto& covariance = fix.covariance_enu_m2;
  require(!covariance || (covariance->allFinite() && covariance->diagonal().minCoeff() > 0),
          "variances are positive numbers");
}

void require_counts(const Decoded& decoded, std::size_t size) {
  const DecoderCounters& counters = decoded.counters;
  require(counters.bytes == size, "every byte is counted");
  require(counters.epochs == decoded.fixes.size(), "every epoch is counted");
  require(counters.sentences + counters.bad_checksum + counters.malformed <= size,
          "a sentence has a byte");
  for (const ByteRange& range : decoded.bytes) {
    require(range.begin < range.end && range.end <= size, "an epoch lies within the bytes");
  }
}

void require_that_nothing_joins(std::string_view bytes, std::size_t cut) {
  const Decoded both = decode(bytes, bytes.size(), cut);
  const Decoded before = decode(bytes.substr(0, cut), cut + 1, cut);
  const Decoded after = decode(bytes.substr(cut), bytes.size(), bytes.size() - cut);
  require(both.fixes.size() == before.fixes.size() + after.fixes.size(), "nothing joins at a cut");
  for (std::size_t i = 0; i < both.fixes.size(); ++i) {
    const std::size_t from = before.fixes.size();
    require(same(both.fixes[i], i < from ? before.fixes[i] : after.fixes[i - from]),
            "nothing joins at a cut");
  }
}

}  // namespace

void check_decoder(std::string_view bytes) {
  if (bytes.empty()) return;
  const Decoded whole = decode(bytes, bytes.size(), bytes.size());
  for (const GnssFix& fix : whole.fixes) require_sane(fix);
  require_counts(whole, bytes.size());
  const std::size_t chance = static_cast<unsigned char>(bytes.back());
  require_same(whole, decode(bytes, 1, bytes.size()), "pieces of one byte give the same fixes");
  require_same(whole, decode(bytes, 1 + chance % 97, bytes.size()), "pieces give the same fixes");
  require_that_nothing_joins(bytes, chance * bytes.size() / 256);
}

}  // namespace plumbline::fuzz
