// SPDX-License-Identifier: MIT
#include "firmware/commands/gnss_output.h"

#include <cmath>
#include <cstdio>
#include <nlohmann/json.hpp>

#include "edge/gnss/time_text.h"

namespace plumbline::commands {
namespace {

using Json = nlohmann::ordered_json;

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::optional<std::string> time_text(const GnssFix& fix) {
  if (fix.time) return gnss::text_of(*fix.time);
  if (fix.time_of_day) return gnss::text_of_day_time(*fix.time_of_day);
  return std::nullopt;
}

Json json_of(const GnssFix& fix) {
  return {{"time_utc", or_null(time_text(fix))},
          {"lat_deg", or_null(fix.latitude_deg)},
          {"lon_deg", or_null(fix.longitude_deg)},
          {"height_ellipsoidal_m", or_null(fix.height_ellipsoidal_m)},
          {"altitude_m", or_null(fix.altitude_m)},
          {"quality", static_cast<int>(fix.quality)},
          {"sigma_e_m", or_null(sigma_m(fix, 0))},
          {"sigma_n_m", or_null(sigma_m(fix, 1))},
          {"sigma_u_m", or_null(sigma_m(fix, 2))},
          {"satellites", or_null(fix.satellites)},
          {"age_s", or_null(fix.correction_age_s)}};
}

Json json_of(const DecoderCounters& counters) {
  return {{"bytes", counters.bytes},
          {"sentences", counters.sentences},
          {"bad_checksum", counters.bad_checksum},
          {"malformed", counters.malformed},
          {"epochs", counters.epochs}};
}

Json json_of(const SerialPortInfo& port) {
  return {{"path", port.path},     {"vid", port.vid},         {"pid", port.pid},
          {"serial", port.serial}, {"product", port.product}, {"manufacturer", port.manufacturer}};
}

// A number right-aligned in its column, or a dash.
void print_cell(const std::optional<double>& value, int width, int decimals) {
  if (value) {
    std::printf(" %*.*f", width, decimals, *value);
  } else {
    std::printf(" %*s", width, "-");
  }
}

void print_row(const GnssFix& fix) {
  std::printf("%-27s", time_text(fix).value_or("-").c_str());
  print_cell(fix.latitude_deg, 14, 9);
  print_cell(fix.longitude_deg, 14, 9);
  print_cell(fix.height_ellipsoidal_m, 10, 3);
  std::printf(" %-12s", name_of(fix.quality).c_str());
  for (int axis = 0; axis < 3; ++axis) print_cell(sigma_m(fix, axis), 7, 3);
  print_cell(fix.satellites, 4, 0);
  print_cell(fix.correction_age_s, 6, 1);
  std::printf("\n");
}

unsigned long long printable(std::uint64_t count) { return count; }

}  // namespace

std::optional<double> sigma_m(const GnssFix& fix, int axis) {
  if (!fix.covariance_enu_m2) return std::nullopt;
  // A sigma came as a decimal and was squared on the way here: back to its digits.
  return std::round(std::sqrt((*fix.covariance_enu_m2)(axis, axis)) * 1e9) / 1e9;
}

std::string name_of(FixQuality quality) {
  switch (quality) {
    case FixQuality::kNone:
      return "none";
    case FixQuality::kSingle:
      return "single";
    case FixQuality::kDifferential:
      return "differential";
    case FixQuality::kPps:
      return "pps";
    case FixQuality::kFixed:
      return "fixed";
    case FixQuality::kFloat:
      return "float";
    case FixQuality::kEstimated:
      return "estimated";
    case FixQuality::kManual:
      return "manual";
    case FixQuality::kSimulated:
      return "simulated";
  }
  return "unknown";
}

void print_fix(const GnssFix& fix, bool json) {
  if (json) {
    std::printf("%s\n", json_of(fix).dump().c_str());
  } else {
    print_row(fix);
  }
}

void print_table_head() {
  std::printf("%-27s %14s %14s %10s %-12s %7s %7s %7s %4s %6s\n", "time_utc", "lat_deg", "lon_deg",
              "height_m", "quality", "sig_e_m", "sig_n_m", "sig_u_m", "sats", "age_s");
}

void print_counters(const DecoderCounters& counters, std::optional<std::uint64_t> reconnections,
                    bool json) {
  if (json) {
    Json all = json_of(counters);
    if (reconnections) all["reconnections"] = *reconnections;
    std::printf("%s\n", all.dump().c_str());
    return;
  }
  std::printf(
      "%llu epochs in %llu sentences (%llu bytes); %llu with a bad checksum, %llu "
      "malformed",
      printable(counters.epochs), printable(counters.sentences), printable(counters.bytes),
      printable(counters.bad_checksum), printable(counters.malformed));
  if (reconnections) std::printf("; %llu reconnections", printable(*reconnections));
  std::printf("\n");
}

void print_ports(const std::vector<SerialPortInfo>& ports, bool json) {
  for (const SerialPortInfo& port : ports) {
    if (json) {
      std::printf("%s\n", json_of(port).dump().c_str());
      continue;
    }
    const std::string usb = port.vid.empty() ? "-" : port.vid + ":" + port.pid;
    std::printf("%-16s %-9s %s %s %s\n", port.path.c_str(), usb.c_str(), port.manufacturer.c_str(),
                port.product.c_str(), port.serial.c_str());
  }
  if (ports.empty() && !json) {
    std::printf("There is no serial port: plug the receiver in, or check its cable and power.\n");
  }
}

}  // namespace plumbline::commands
