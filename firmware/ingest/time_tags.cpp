// SPDX-License-Identifier: MIT
#include "firmware/ingest/time_tags.h"

#include <cmath>
#include <string>

#include "firmware/ingest/number.h"

namespace plumbline::ingest {
namespace {

using std::chrono::microseconds;
using std::chrono::minutes;

std::optional<double> tag_value(std::string_view text) {
  const std::size_t bar = text.find('/');
  if (bar == std::string_view::npos) return parse_number(text);
  const auto numerator = parse_number(text.substr(0, bar));
  const auto denominator = parse_number(text.substr(bar + 1));
  if (!numerator || !denominator || *denominator == 0) return std::nullopt;
  return *numerator / *denominator;
}

std::string text_of(const Tags& tags, std::string_view key) {
  const auto found = tags.find(key);
  return found == tags.end() ? "" : std::string(trimmed(found->second));
}

// `count` whole numbers of `text`, separated by any one character.
std::vector<int> whole_numbers(std::string_view text, std::size_t count) {
  std::vector<int> numbers;
  while (numbers.size() < count && !text.empty()) {
    const std::size_t digits = std::min(text.find_first_not_of("0123456789"), text.size());
    if (digits == 0 || digits > 4) return {};
    numbers.push_back(std::stoi(std::string(text.substr(0, digits))));
    text.remove_prefix(std::min(digits + 1, text.size()));
  }
  return numbers.size() == count ? numbers : std::vector<int>();
}

std::optional<std::chrono::sys_days> day_of(int year, int month, int day) {
  const std::chrono::year_month_day date{std::chrono::year(year),
                                         std::chrono::month(static_cast<unsigned>(month)),
                                         std::chrono::day(static_cast<unsigned>(day))};
  if (!date.ok() || year < 1980) return std::nullopt;
  return std::chrono::sys_days(date);
}

// "2014:10:19 13:20:51"
std::optional<UtcTime> clock_of(const std::string& text) {
  const std::vector<int> n = whole_numbers(text, 6);
  if (n.empty() || n[3] > 23 || n[4] > 59 || n[5] > 60) return std::nullopt;
  const auto day = day_of(n[0], n[1], n[2]);
  if (!day) return std::nullopt;
  return *day + std::chrono::hours(n[3]) + minutes(n[4]) + std::chrono::seconds(n[5]) +
         microseconds(0);
}

// The digits behind the point of the second.
std::optional<microseconds> subseconds_of(const std::string& text) {
  if (text.empty() || text.find_first_not_of("0123456789") != std::string::npos) {
    return std::nullopt;
  }
  const auto fraction = parse_number("0." + text);
  if (!fraction) return std::nullopt;
  return microseconds(std::llround(*fraction * 1e6));
}

// "+09:00", "-03:30", "Z"
std::optional<minutes> offset_of(const std::string& text) {
  if (text == "Z") return minutes(0);
  if (text.size() < 6 || (text[0] != '+' && text[0] != '-')) return std::nullopt;
  const std::vector<int> n = whole_numbers(std::string_view(text).substr(1), 2);
  if (n.empty() || n[0] > 15 || n[1] > 59) return std::nullopt;
  const minutes offset(60 * n[0] + n[1]);
  return text[0] == '-' ? -offset : offset;
}

std::optional<UtcTime> gps_time_of(const Tags& tags) {
  const std::vector<int> date = whole_numbers(text_of(tags, "Exif.GPSInfo.GPSDateStamp"), 3);
  const std::vector<double> hms = tag_numbers(text_of(tags, "Exif.GPSInfo.GPSTimeStamp"));
  if (date.empty() || hms.size() != 3) return std::nullopt;
  const auto day = day_of(date[0], date[1], date[2]);
  const double seconds = 3600 * hms[0] + 60 * hms[1] + hms[2];
  if (!day || !(seconds >= 0 && seconds <= 86'401)) return std::nullopt;
  return *day + microseconds(std::llround(seconds * 1e6));
}

}  // namespace

std::vector<double> tag_numbers(std::string_view text) {
  std::vector<double> numbers;
  text = trimmed(text);
  while (!text.empty()) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const auto value = tag_value(text.substr(0, end));
    if (!value) return {};
    numbers.push_back(*value);
    text = trimmed(text.substr(end));
  }
  return numbers;
}

std::optional<double> tag_number(std::string_view text) {
  const std::vector<double> numbers = tag_numbers(text);
  return numbers.size() == 1 ? std::optional(numbers[0]) : std::nullopt;
}

PhotoTime time_of(const Tags& tags) {
  PhotoTime time;
  time.camera_clock = clock_of(text_of(tags, "Exif.Photo.DateTimeOriginal"));
  const auto fraction = subseconds_of(text_of(tags, "Exif.Photo.SubSecTimeOriginal"));
  if (time.camera_clock && fraction) {
    *time.camera_clock += *fraction;
    time.has_subseconds = true;
  }
  time.offset = offset_of(text_of(tags, "Exif.Photo.OffsetTimeOriginal"));
  time.gps = gps_time_of(tags);
  return time;
}

std::optional<UtcTime> utc_of(const PhotoTime& time) {
  if (!time.camera_clock) return time.gps;
  if (time.offset) return *time.camera_clock - *time.offset;
  if (!time.gps) return std::nullopt;
  constexpr std::chrono::seconds kQuarter(900);
  constexpr std::chrono::seconds kNear(10);
  constexpr std::chrono::hours kFarthest(15);
  const microseconds ahead = *time.camera_clock - *time.gps;
  const auto quarters = std::llround(std::chrono::duration<double>(ahead) / kQuarter);
  const microseconds offset = quarters * kQuarter;
  if (std::chrono::abs(ahead - offset) > kNear || std::chrono::abs(offset) > kFarthest) {
    return time.gps;
  }
  return *time.camera_clock - offset;
}

}  // namespace plumbline::ingest
