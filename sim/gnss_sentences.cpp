// SPDX-License-Identifier: MIT
#include "sim/gnss_sentences.h"

#include <array>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace plumbline::sim {
namespace {

using std::chrono::sys_days;

template <typename... Values>
std::string print(const char* format, Values... values) {
  std::array<char, 256> text{};
  std::snprintf(text.data(), text.size(), format, values...);
  return text.data();
}

std::chrono::hh_mm_ss<std::chrono::microseconds> time_of_day(UtcTime utc) {
  return std::chrono::hh_mm_ss(utc - std::chrono::floor<std::chrono::days>(utc));
}

int as_int(std::chrono::microseconds::rep count) { return static_cast<int>(count); }

std::string nmea_time(UtcTime utc) {
  const auto time = time_of_day(utc);
  return print("%02d%02d%02d.%02d", as_int(time.hours().count()), as_int(time.minutes().count()),
               as_int(time.seconds().count()), as_int(time.subseconds().count() / 10000));
}

std::chrono::year_month_day date_of(UtcTime utc) {
  return std::chrono::year_month_day(std::chrono::floor<std::chrono::days>(utc));
}

// Degrees and minutes; rounded as one number, so that no minute reads 60.
std::string angle(double degrees, const char* format, char positive, char negative) {
  constexpr long long kPerMinute = 10'000'000;
  const long long units = std::llround(std::abs(degrees) * 60 * static_cast<double>(kPerMinute));
  const long long minutes = units / kPerMinute;
  return print(format, minutes / 60, minutes % 60, units % kPerMinute,
               degrees < 0 ? negative : positive);
}

std::string place_fields(const SaidEpoch& epoch) {
  if (epoch.quality == FixQuality::kNone) return ",,,";
  return angle(epoch.place.latitude_deg, "%02lld%02lld.%07lld,%c", 'N', 'S') + "," +
         angle(epoch.place.longitude_deg, "%03lld%02lld.%07lld,%c", 'E', 'W');
}

}  // namespace

std::string nmea_line(const std::string& body) {
  unsigned sum = 0;
  for (const char c : body) sum ^= static_cast<unsigned char>(c);
  return "$" + body + print("*%02X\r\n", sum);
}

std::string gga_of(const SaidEpoch& epoch) {
  const std::string begin = "GNGGA," + nmea_time(epoch.utc) + "," + place_fields(epoch);
  if (epoch.quality == FixQuality::kNone) return nmea_line(begin + ",0,03,1.0,,M,,M,,");
  return nmea_line(
      begin + print(",%d,17,1.0,%.3f,M,%.3f,M,1.2,0001", static_cast<int>(epoch.quality),
                    epoch.place.height_ellipsoidal_m - epoch.separation_m, epoch.separation_m));
}

std::string gst_of(const SaidEpoch& epoch) {
  const std::string begin = "GNGST," + nmea_time(epoch.utc);
  if (epoch.quality == FixQuality::kNone) return nmea_line(begin + ",,,,,,,");
  return nmea_line(begin + print(",1.0,,,,%.3f,%.3f,%.3f", epoch.sigma.horizontal_m,
                                 epoch.sigma.horizontal_m, epoch.sigma.vertical_m));
}

std::string rmc_of(const SaidEpoch& epoch) {
  const auto date = date_of(epoch.utc);
  const bool valid = epoch.quality != FixQuality::kNone;
  return nmea_line("GNRMC," + nmea_time(epoch.utc) + (valid ? ",A," : ",V,") + place_fields(epoch) +
                   ",0.05,," +
                   print("%02u%02u%02d", static_cast<unsigned>(date.day()),
                         static_cast<unsigned>(date.month()), static_cast<int>(date.year()) % 100) +
                   (valid ? ",,,D,V" : ",,,N,V"));
}

std::string llh_header() { return "%  GPST  latitude(deg) longitude(deg) height(m) Q ns\n"; }

std::string llh_of(const SaidEpoch& epoch) {
  if (epoch.quality == FixQuality::kNone) return {};
  const UtcTime gps = epoch.utc + std::chrono::seconds(18);  // since 2017
  const auto time = time_of_day(gps);
  const auto date = date_of(gps);
  return print("%04d/%02u/%02u %02d:%02d:%02d.%03d ", static_cast<int>(date.year()),
               static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
               as_int(time.hours().count()), as_int(time.minutes().count()),
               as_int(time.seconds().count()), as_int(time.subseconds().count() / 1000)) +
         print("%14.9f %14.9f %10.4f %d 17 %8.4f %8.4f %8.4f 0.0000 0.0000 0.0000 1.20 9.9\n",
               epoch.place.latitude_deg, epoch.place.longitude_deg,
               epoch.place.height_ellipsoidal_m, epoch.quality == FixQuality::kFixed ? 1 : 2,
               epoch.sigma.horizontal_m, epoch.sigma.horizontal_m, epoch.sigma.vertical_m);
}

}  // namespace plumbline::sim
