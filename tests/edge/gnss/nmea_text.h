// SPDX-License-Identifier: MIT
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

#include "edge/gnss/nmea_parser.h"

namespace plumbline::gnss {

// "GPGGA,..." as a sentence on a line, with its checksum.
inline std::string sentence(std::string_view body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  char ending[8];
  std::snprintf(ending, sizeof ending, "*%02X\r\n", sum);
  std::string line = "$";
  return line.append(body).append(ending);
}

struct Parsed {
  std::vector<GnssFix> fixes;
  DecoderCounters counters;
  std::optional<BasePosition> base;
  std::optional<GroundVelocity> velocity;
};

// All of it at once, or in pieces of `piece` bytes.
inline Parsed parse(std::string_view bytes, std::size_t piece = std::string_view::npos) {
  Parsed parsed;
  NmeaParser parser([&](const GnssFix& fix) { parsed.fixes.push_back(fix); });
  while (!bytes.empty()) {
    parser.feed(bytes.substr(0, piece));
    bytes.remove_prefix(std::min(piece, bytes.size()));
  }
  parser.finish();
  parsed.counters = parser.counters();
  parsed.base = parser.base();
  parsed.velocity = parser.ground_velocity();
  return parsed;
}

}  // namespace plumbline::gnss
