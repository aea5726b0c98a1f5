// SPDX-License-Identifier: MIT
#include "firmware/commands/gnss_command.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>

#include "edge/base/result.h"
#include "edge/gnss/log_parser.h"
#include "edge/gnss/time_text.h"

namespace plumbline::commands {
namespace {

using Json = nlohmann::ordered_json;

struct GnssArguments {
  std::string source;
  int baud = 0;
  bool json = false;
};

template <typename T>
Json or_null(const std::optional<T>& value) {
  return value ? Json(*value) : Json(nullptr);
}

std::optional<std::string> time_text(const GnssFix& fix) {
  if (fix.time) return gnss::text_of(*fix.time);
  if (fix.time_of_day) return gnss::text_of_day_time(*fix.time_of_day);
  return std::nullopt;
}

std::optional<double> sigma_m(const GnssFix& fix, int axis) {
  if (!fix.covariance_enu_m2) return std::nullopt;
  // A sigma came as a decimal and was squared on the way here: back to its digits.
  return std::round(std::sqrt((*fix.covariance_enu_m2)(axis, axis)) * 1e9) / 1e9;
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

void print_table_head() {
  std::printf("%-27s %14s %14s %10s %-12s %7s %7s %7s %4s %6s\n", "time_utc", "lat_deg", "lon_deg",
              "height_m", "quality", "sig_e_m", "sig_n_m", "sig_u_m", "sats", "age_s");
}

void print_counters(const DecoderCounters& counters, bool json) {
  if (json) {
    std::printf("%s\n", json_of(counters).dump().c_str());
    return;
  }
  std::printf(
      "%llu epochs in %llu sentences (%llu bytes); %llu with a bad checksum, %llu "
      "malformed\n",
      static_cast<unsigned long long>(counters.epochs),
      static_cast<unsigned long long>(counters.sentences),
      static_cast<unsigned long long>(counters.bytes),
      static_cast<unsigned long long>(counters.bad_checksum),
      static_cast<unsigned long long>(counters.malformed));
}

std::string shown_name(const std::string& source) {
  return source == "-" ? "standard input" : "'" + source + "'";
}

Error cannot_read(const std::string& source, const std::string& why) {
  return {"Cannot read " + shown_name(source) + ": " + why + "."};
}

bool is_port(const std::string& source) {
  std::error_code error;
  return std::filesystem::is_character_file(source, error) && source != "/dev/stdin" &&
         source != "/dev/null";
}

// An open file of which the destructor closes what it opened.
class Input {
 public:
  explicit Input(const std::string& source)
      : owned_(source != "-"), fd_(owned_ ? ::open(source.c_str(), O_RDONLY | O_CLOEXEC) : 0) {}
  ~Input() {
    if (owned_ && fd_ >= 0) ::close(fd_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  int fd() const { return fd_; }

 private:
  bool owned_;
  int fd_;
};

Result<Input*> opened(Input& input, const std::string& source) {
  if (input.fd() < 0) return cannot_read(source, std::strerror(errno));
  return &input;
}

// Hands on what there is as soon as it is there: a pipe may be live.
Status pump(int fd, const std::string& source, gnss::LogParser& parser) {
  std::array<char, 65536> chunk{};
  while (true) {
    const ssize_t count = ::read(fd, chunk.data(), chunk.size());
    if (count == 0) break;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot_read(source, std::strerror(errno));
    parser.feed({chunk.data(), static_cast<std::size_t>(count)});
    std::fflush(stdout);
  }
  parser.finish();
  return Done{};
}

Status show(const GnssArguments& arguments) {
  const std::string& source = arguments.source;
  if (is_port(source)) {
    return Error{shown_name(source) +
                 " is a device, and receivers are not read live yet: set its speed with stty and "
                 "pipe it in (cat " +
                 source + " | plumbline gnss -)."};
  }
  Input input(source);
  if (const auto open = opened(input, source); !open) return open.error();
  bool first = true;
  gnss::LogParser parser([&](const GnssFix& fix) {
    if (!arguments.json && std::exchange(first, false)) print_table_head();
    if (arguments.json) {
      std::printf("%s\n", json_of(fix).dump().c_str());
    } else {
      print_row(fix);
    }
  });
  if (const Status read = pump(input.fd(), source, parser); !read) return read;
  const DecoderCounters& counters = parser.counters();
  if (counters.sentences == 0) {
    return Error{shown_name(source) + " " + parser.reason_for_nothing() + "."};
  }
  if (counters.epochs == 0) {
    std::fprintf(stderr, "%s %s.\n", shown_name(source).c_str(),
                 parser.reason_for_nothing().c_str());
  }
  print_counters(counters, arguments.json);
  return Done{};
}

}  // namespace

void add_gnss(CLI::App& app, int& status) {
  auto arguments = std::make_shared<GnssArguments>();
  CLI::App* gnss = app.add_subcommand("gnss", "What a receiver says, from a log or a pipe");
  gnss->add_option("source", arguments->source,
                   "NMEA or RTKLIB log (.llh, .pos); - for standard input")
      ->required()
      ->type_name("PORT|FILE|-");
  gnss->add_option("--baud", arguments->baud, "Speed of a serial port; of no effect on files")
      ->check(CLI::Range(300, 4000000));
  gnss->add_flag("--json", arguments->json, "One JSON object per position epoch, counters last");
  gnss->footer("Example: plumbline gnss flight.nmea --json | head -3");
  gnss->callback([arguments, &status] {
    const Status shown = show(*arguments);
    std::fflush(stdout);
    if (!shown) std::fprintf(stderr, "%s\n", shown.error().sentence.c_str());
    status = shown ? 0 : 1;
  });
}

}  // namespace plumbline::commands
