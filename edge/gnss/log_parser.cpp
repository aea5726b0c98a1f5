// SPDX-License-Identifier: MIT
#include "edge/gnss/log_parser.h"

#include <algorithm>
#include <utility>

namespace plumbline::gnss {

LogParser::LogParser(Sink sink)
    : sink_(std::move(sink)),
      nmea_([this](const GnssFix& fix) { hand_on(LogKind::kNmea, fix); }),
      rtklib_([this](const GnssFix& fix) { hand_on(LogKind::kRtklib, fix); }) {}

// Until one of them has decided, both get the bytes in step: which is first must not depend on the
// pieces in which they come. An epoch is handed out at the end of a line or the begin of a
// sentence.
void LogParser::feed(std::string_view bytes) {
  while (kind_ == LogKind::kUnknown && !bytes.empty()) {
    const std::size_t end = std::min(bytes.find_first_of("\r\n$"), bytes.size() - 1);
    nmea_.feed(bytes.substr(0, end + 1));
    if (kind_ != LogKind::kNmea) rtklib_.feed(bytes.substr(0, end + 1));
    bytes.remove_prefix(end + 1);
  }
  if (kind_ != LogKind::kRtklib) nmea_.feed(bytes);
  if (kind_ != LogKind::kNmea) rtklib_.feed(bytes);
}

void LogParser::flush() {
  if (kind_ != LogKind::kRtklib) nmea_.flush();
}

void LogParser::cut() {
  rtklib_.begin_amid_a_line();
  finish();
}

ByteRange LogParser::epoch_bytes() const {
  return kind_ == LogKind::kRtklib ? rtklib_.epoch_bytes() : nmea_.epoch_bytes();
}

void LogParser::finish() {
  if (kind_ != LogKind::kRtklib) nmea_.finish();
  if (kind_ != LogKind::kNmea) rtklib_.finish();
}

const DecoderCounters& LogParser::counters() const {
  return kind_ == LogKind::kRtklib ? rtklib_.counters() : nmea_.counters();
}

bool LogParser::gps_time_assumed() const {
  return kind_ == LogKind::kRtklib && !rtklib_.time_system_named();
}

std::string LogParser::reason_for_nothing() const {
  const DecoderCounters& nmea = nmea_.counters();
  if (nmea.bytes == 0) return "is empty";
  if (rtklib_.refusal()) return "cannot be used: " + *rtklib_.refusal();
  if (nmea.sentences > 0) {
    return "holds NMEA sentences but no GGA, GNS or RMC among them; switch one of these on in the "
           "receiver";
  }
  if (nmea.bad_checksum + nmea.malformed > 0) {
    return "holds no whole NMEA sentence (" + std::to_string(nmea.bad_checksum) +
           " with a bad checksum, " + std::to_string(nmea.malformed) +
           " malformed); check the baud rate with which it was recorded";
  }
  return "holds neither NMEA sentences nor RTKLIB solution lines; pass an NMEA log, a .llh or a "
         ".pos";
}

void LogParser::hand_on(LogKind from, const GnssFix& fix) {
  if (kind_ == LogKind::kUnknown) kind_ = from;
  if (kind_ == from) sink_(fix);
}

}  // namespace plumbline::gnss
