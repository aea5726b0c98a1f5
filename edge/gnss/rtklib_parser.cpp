// SPDX-License-Identifier: MIT
#include "edge/gnss/rtklib_parser.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

#include "edge/gnss/text_fields.h"

namespace plumbline::gnss {
namespace {

using Columns = std::vector<std::string_view>;

constexpr std::string_view kSeparators = " \t,;\r";
constexpr std::size_t kLongestLine = 1000;
constexpr std::size_t kFewestColumns = 7;  // date to ns

// Columns after date and time.
enum Column { kLatitude = 2, kLongitude, kHeight, kQ, kSatellites, kSdn, kAge = 13 };

bool says(std::string_view line, std::string_view what) {
  return line.find(what) != std::string_view::npos;
}

std::optional<std::string> refusal_of(std::string_view header) {
  const std::string ask = "; write latitude, longitude and ellipsoidal height in decimal degrees";
  if (says(header, "x-ecef")) return "its positions are ECEF coordinates" + ask;
  if (says(header, "e-baseline")) return "its positions are a baseline from the base" + ask;
  if (says(header, "latitude(d'")) return "its angles are in degrees, minutes and seconds" + ask;
  if (says(header, "/geodetic")) return "its heights are above a geoid that it does not name" + ask;
  if (says(header, "height=Tokyo")) return "its datum is Tokyo" + ask + " in WGS84";
  return std::nullopt;
}

std::optional<GpsCivilTime> calendar_time(std::string_view date, std::string_view time) {
  const auto ymd = split(date, "/", false);
  const auto hms = split(time, ":", false);
  if (ymd.size() != 3 || hms.size() != 3) return std::nullopt;
  const auto y = whole_number(ymd[0]), m = whole_number(ymd[1]), d = whole_number(ymd[2]);
  const auto h = whole_number(hms[0]), min = whole_number(hms[1]);
  const auto s = seconds(hms[2]);
  if (!y || !m || !d || !h || !min || !s) return std::nullopt;
  using namespace std::chrono;
  const year_month_day day{year(*y), month(static_cast<unsigned>(*m)),
                           std::chrono::day(static_cast<unsigned>(*d))};
  if (!day.ok() || *y < 1980 || *h > 23 || *min > 59 || *s >= std::chrono::seconds(61)) {
    return std::nullopt;
  }
  return local_days(day) + hours(*h) + minutes(*min) + *s;
}

std::optional<GpsCivilTime> week_time(std::string_view week, std::string_view tow) {
  const auto w = whole_number(week);
  const auto s = seconds(tow);
  if (!w || *w < 1 || *w > 9999 || !s || *s >= std::chrono::weeks(1)) return std::nullopt;
  return gps_time_of(*w, *s);
}

std::optional<FixQuality> quality_of(std::string_view q) {
  constexpr std::array kQuality = {FixQuality::kFixed,        FixQuality::kFloat,
                                   FixQuality::kDifferential, FixQuality::kDifferential,
                                   FixQuality::kSingle,       FixQuality::kFloat};
  if (q.size() != 1 || q[0] < '0' || q[0] > '6') return std::nullopt;
  if (q[0] == '0') return FixQuality::kNone;
  return kQuality[static_cast<std::size_t>(q[0] - '1')];
}

double signed_square(double root) { return root * std::abs(root); }

// In the file: north, east, up, north-east, east-up, up-north. Rounding to 0.1 mm can leave a
// matrix that is none; its variances are still what was stated.
std::optional<Eigen::Matrix3d> covariance_of(const std::array<double, 6>& sd) {
  const auto [n, e, u, ne, eu, un] = sd;
  if (n <= 0 || e <= 0 || u <= 0) return std::nullopt;
  const Eigen::Matrix3d variances = Eigen::Vector3d(e * e, n * n, u * u).asDiagonal();
  Eigen::Matrix3d full = variances;
  full(0, 1) = full(1, 0) = signed_square(ne);
  full(0, 2) = full(2, 0) = signed_square(eu);
  full(1, 2) = full(2, 1) = signed_square(un);
  const Eigen::LLT<Eigen::Matrix3d> factor(full);
  return factor.info() == Eigen::Success ? full : variances;
}

// Sigmas from column kSdn on: all six, or empty when the line ends before them; false: nonsense.
bool read_sigmas(const Columns& columns, GnssFix& fix) {
  if (columns.size() <= kSdn) return true;
  if (columns.size() < kSdn + 6) return false;
  std::array<double, 6> sd{};
  for (std::size_t i = 0; i < sd.size(); ++i) {
    const auto value = decimal(columns[kSdn + i]);
    if (!value) return false;
    sd[i] = *value;
  }
  fix.covariance_enu_m2 = covariance_of(sd);
  return true;
}

bool read_place(const Columns& columns, GnssFix& fix) {
  fix.latitude_deg = decimal(columns[kLatitude]);
  fix.longitude_deg = decimal(columns[kLongitude]);
  fix.height_ellipsoidal_m = decimal(columns[kHeight]);
  fix.satellites = whole_number(columns[kSatellites]);
  return fix.latitude_deg && fix.longitude_deg && fix.height_ellipsoidal_m && fix.satellites &&
         std::abs(*fix.latitude_deg) <= 90 && std::abs(*fix.longitude_deg) <= 360;
}

// The last byte that stands in no text, or npos.
std::size_t find_last_binary(std::string_view line) {
  const auto is_binary = [](char c) { return (c < ' ' || c > '~') && c != '\t' && c != '\r'; };
  const auto last = std::find_if(line.rbegin(), line.rend(), is_binary);
  return last == line.rend() ? std::string_view::npos
                             : static_cast<std::size_t>(line.rend() - last) - 1;
}

// The line from its date on, where other bytes stand before it; empty where there is none.
std::string_view from_date(std::string_view text) {
  constexpr std::size_t kDigitsOfYear = 4;
  const std::size_t slash = text.find('/');
  if (slash == std::string_view::npos || slash < kDigitsOfYear) return {};
  return text.substr(slash - kDigitsOfYear);
}

}  // namespace

void RtklibParser::feed(std::string_view bytes) {
  while (!bytes.empty()) {
    const std::size_t length = bytes.find('\n');
    if (length == std::string_view::npos) {
      counters_.bytes += bytes.size();
      keep(bytes);
      return;
    }
    counters_.bytes += length + 1;
    if (!kept_.empty()) keep(bytes.substr(0, length));
    end_line(kept_.empty() ? bytes.substr(0, length) : std::string_view(kept_));
    kept_.clear();
    bytes.remove_prefix(length + 1);
  }
}

void RtklibParser::finish() {
  end_line(kept_);
  kept_.clear();
}

void RtklibParser::begin_amid_a_line() {
  kept_.clear();
  amid_a_line_ = true;
}

// Of what is endless (a binary message without the byte of a line end) only the last is kept.
void RtklibParser::keep(std::string_view part) {
  kept_.append(part);
  if (kept_.size() <= kLongestLine) return;
  kept_.erase(0, kept_.size() - kLongestLine);
  cut_off_ = true;
}

void RtklibParser::end_line(std::string_view line) {
  const bool whole = !std::exchange(cut_off_, false);
  if (std::exchange(amid_a_line_, false) && !line.starts_with('%')) return;
  if (line.find_first_not_of(kSeparators) == std::string_view::npos) return;
  if (line[0] == '%' && whole) {
    take_comment(line);
    return;
  }
  if (refusal_) return;
  const std::string_view text = whole ? line : line.substr(1);
  const std::size_t binary = find_last_binary(text);
  const bool after_others = !whole || binary != std::string_view::npos;
  take_solution(after_others ? from_date(text.substr(binary + 1)) : line);
}

void RtklibParser::take_solution(std::string_view line) {
  if (line.empty()) return;
  const auto fix = line.size() <= kLongestLine ? read_line(line) : std::nullopt;
  if (!fix) {
    ++counters_.malformed;
    return;
  }
  ++counters_.sentences;
  ++counters_.epochs;
  epoch_bytes_ = {counters_.bytes - line.size() - 1, counters_.bytes};
  sink_(*fix);
}

void RtklibParser::take_comment(std::string_view line) {
  if (const auto refusal = refusal_of(line)) refusal_ = refusal;
  if (!says(line, "latitude")) return;
  const Columns columns = split(line.substr(1), kSeparators, true);
  if (columns.empty()) return;
  if (columns[0] == "GPST") time_system_ = TimeSystem::kGps;
  if (columns[0] == "UTC") time_system_ = TimeSystem::kUtc;
  if (columns[0] == "JST") time_system_ = TimeSystem::kJapan;
}

UtcTime RtklibParser::utc_from(GpsCivilTime written) const {
  switch (time_system_.value_or(TimeSystem::kGps)) {
    case TimeSystem::kUtc:
      return UtcTime(written.time_since_epoch());
    case TimeSystem::kJapan:
      return UtcTime(written.time_since_epoch()) - std::chrono::hours(9);
    case TimeSystem::kGps:
      break;
  }
  return utc_of(written);
}

std::optional<GnssFix> RtklibParser::read_line(std::string_view line) const {
  const Columns columns = split(line, kSeparators, true);
  if (columns.size() < kFewestColumns) return std::nullopt;
  const auto written = says(columns[0], "/") ? calendar_time(columns[0], columns[1])
                                             : week_time(columns[0], columns[1]);
  const auto quality = quality_of(columns[kQ]);
  GnssFix fix;
  if (!written || !quality || !read_place(columns, fix)) return std::nullopt;
  if (!read_sigmas(columns, fix)) return std::nullopt;
  fix.quality = *quality;
  fix.time = utc_from(*written);
  fix.time_of_day = *fix.time - std::chrono::floor<std::chrono::days>(*fix.time);
  if (columns.size() > kAge) fix.correction_age_s = decimal(columns[kAge]);
  if (fix.quality == FixQuality::kNone) {
    fix.latitude_deg = fix.longitude_deg = fix.height_ellipsoidal_m = std::nullopt;
  }
  return fix;
}

}  // namespace plumbline::gnss
