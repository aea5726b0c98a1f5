// SPDX-License-Identifier: MIT
#include "edge/gnss/time_text.h"

#include <array>
#include <cstdio>

namespace plumbline::gnss {

std::string text_of_day_time(std::chrono::microseconds since_midnight) {
  const std::chrono::hh_mm_ss time(since_midnight);
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "T%02d:%02d:%02d.%06d",
                static_cast<int>(time.hours().count()), static_cast<int>(time.minutes().count()),
                static_cast<int>(time.seconds().count()),
                static_cast<int>(time.subseconds().count()));
  std::string result = text.data();
  const std::size_t shortest = result.size() - 4;
  while (result.size() > shortest && result.back() == '0') result.pop_back();
  return result + "Z";
}

std::string text_of(UtcTime time) {
  const auto midnight = std::chrono::floor<std::chrono::days>(time);
  const std::chrono::year_month_day date{midnight};
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%04d-%02u-%02u", static_cast<int>(date.year()),
                static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()));
  return text.data() + text_of_day_time(time - midnight);
}

}  // namespace plumbline::gnss
