// SPDX-License-Identifier: MIT
#include "tests/talk/receiver_talk.h"

#include <cmath>
#include <cstdio>

#include "sim/random.h"
#include "tests/edge/gnss/nmea_text.h"

namespace plumbline::talk {
namespace {

constexpr double kMinutesOf100m = 0.054077;  // of latitude, at 35.67 degrees on WGS84

std::string time_text(int epoch) {
  char text[32];
  const int seconds = epoch / 10;
  std::snprintf(text, sizeof text, "10%02d%02d.%02d", seconds / 60 % 60, seconds % 60,
                epoch % 10 * 10);
  return text;
}

double minutes_of_latitude(int epoch) { return 40.1234567 + epoch * 1e-6; }

std::string decimal(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string burst(int epoch, double minutes) {
  const std::string time = time_text(epoch);
  const std::string place = ",35" + decimal(minutes, 7) + ",N,13945.7654321,E,";
  std::string text;
  if (epoch % 10 == 0) {
    text += gnss::sentence("GNRMC," + time + ",A" + place + "0.05,,201126,,,D,V");
  }
  text += gnss::sentence("GNGGA," + time + place + "4,17,1.0,52.140,M,38.123,M,1.2,0001");
  return text + gnss::sentence("GNGST," + time + ",1.0,,,,0.011,0.012,0.025");
}

}  // namespace

std::string positions(int epoch) { return burst(epoch, minutes_of_latitude(epoch)); }

std::string jumped(int epoch) { return burst(epoch, minutes_of_latitude(epoch) + kMinutesOf100m); }

std::string without_position(int epoch) {
  return gnss::sentence("GNGGA," + time_text(epoch) + ",,,,,0,03,9.9,,M,,M,,");
}

std::string without_epochs(int /*epoch*/) {
  return gnss::sentence("GPGSV,1,1,02,05,06,110,19,07,44,210,33");
}

std::string noise(int epoch) {
  sim::Random random(20261120, static_cast<std::uint64_t>(epoch));
  std::string bytes;
  for (int i = 0; i < 90; ++i) bytes.push_back(static_cast<char>(random.next() & 0xFF));
  return bytes;
}

bool was_said(const GnssFix& fix) {
  if (!fix.time_of_day || !fix.latitude_deg || !fix.longitude_deg) return false;
  const auto since = *fix.time_of_day - std::chrono::hours(10);
  const int epoch = static_cast<int>(since / std::chrono::milliseconds(100));
  const double minutes = (*fix.latitude_deg - 35) * 60 - minutes_of_latitude(epoch);
  const bool there = std::abs(minutes) < 1e-8 || std::abs(minutes - kMinutesOf100m) < 1e-8;
  const bool same = std::abs(*fix.longitude_deg - (139 + 45.7654321 / 60)) < 1e-10 &&
                    fix.height_ellipsoidal_m == 90.263 && fix.quality == FixQuality::kFixed;
  return there && same && since % std::chrono::milliseconds(100) == since.zero();
}

}  // namespace plumbline::talk
