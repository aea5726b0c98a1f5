// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>
#include <utility>

#include "firmware/config/key.h"

// How the table of keys is written. Each maker takes a name, a range and a `field`: what gives the
// member of a Config, constant or not, in which the value lives.

#define PLUMBLINE_FIELD(member) ([](auto& config) -> auto& { return config.member; })

namespace plumbline::config {

struct Name {
  std::string_view section;
  std::string_view name;
  std::string_view sentence;
};

struct Unit {
  std::string_view of;     // "seconds"; empty: a plain number
  std::int64_t per_s = 1;  // of a duration
};
inline constexpr Unit kPlain{""};
inline constexpr Unit kMetres{"metres"};
inline constexpr Unit kMetresPerSecond{"metres per second"};
inline constexpr Unit kPixels{"pixels"};
inline constexpr Unit kMegabytes{"megabytes"};
inline constexpr Unit kDegrees{"degrees"};
inline constexpr Unit kDioptres{"dioptres"};
inline constexpr Unit kPerSecond{"frames per second"};
inline constexpr Unit kSeconds{"seconds", 1};
inline constexpr Unit kMilliseconds{"milliseconds", 1'000};
inline constexpr Unit kMicroseconds{"microseconds", 1'000'000};

// Both ends belong to it.
struct Span {
  double low;
  double high;
};

inline double number_of(double field, Unit) { return field; }
inline double number_of(int field, Unit) { return field; }
template <typename Rep, typename Period>
double number_of(std::chrono::duration<Rep, Period> field, Unit unit) {
  return static_cast<double>(field.count()) * static_cast<double>(unit.per_s) /
         static_cast<double>(Period::den);
}

inline void put_number(double value, Unit, double& field) { field = value; }
inline void put_number(double value, Unit, int& field) { field = static_cast<int>(value); }
template <typename Rep, typename Period>
void put_number(double value, Unit unit, std::chrono::duration<Rep, Period>& field) {
  const double ticks = value * (static_cast<double>(Period::den) / static_cast<double>(unit.per_s));
  field = std::chrono::duration<Rep, Period>(static_cast<Rep>(std::llround(ticks)));
}

// A count of something is whole; so is a duration in its smallest unit where that is a second.
template <typename Field>
inline constexpr bool kIsWhole =
    std::is_same_v<Field, int> || std::is_same_v<Field, std::chrono::seconds>;

template <typename Field>
bool is_good(double value, Span span) {
  if (!(value >= span.low && value <= span.high)) return false;
  return !kIsWhole<Field> || value == std::floor(value);
}

template <typename Field>
std::string wanted(Unit unit, Span span) {
  std::string text = kIsWhole<Field> ? "a whole number" : "a number";
  if (!unit.of.empty()) text += " of " + std::string(unit.of);
  return text + " from " + figures(span.low) + " to " + figures(span.high);
}

template <typename Get>
using FieldOf = std::remove_cvref_t<decltype(std::declval<Get>()(std::declval<Config&>()))>;

template <typename Get>
Key number(Name name, Unit unit, Span span, Get field) {
  using Field = FieldOf<Get>;
  return {name.section,
          name.name,
          name.sentence,
          wanted<Field>(unit, span),
          [=](const Config& config) -> Value { return number_of(field(config), unit); },
          [=](Config& config, const Value& value) {
            const double* given = std::get_if<double>(&value);
            if (given == nullptr || !is_good<Field>(*given, span)) return false;
            put_number(*given, unit, field(config));
            return true;
          }};
}

// An optional member: a number, or `nothing`, which empties it.
template <typename Get>
Key number_or(const Value& nothing, Name name, Unit unit, Span span, Get field) {
  using Field = typename FieldOf<Get>::value_type;
  return {name.section,
          name.name,
          name.sentence,
          toml_of(nothing) + " or " + wanted<Field>(unit, span),
          [=](const Config& config) -> Value {
            const auto& held = field(config);
            return held ? Value(number_of(*held, unit)) : nothing;
          },
          [=](Config& config, const Value& value) {
            auto& held = field(config);
            if (value == nothing) {
              held.reset();
              return true;
            }
            const double* given = std::get_if<double>(&value);
            if (given == nullptr || !is_good<Field>(*given, span)) return false;
            put_number(*given, unit, held.emplace());
            return true;
          }};
}

// 0 means none.
template <typename Get>
Key number_or_none(Name name, Unit unit, Span span, Get field) {
  return number_or(Value(0.0), name, unit, span, field);
}

// "auto" leaves it to the camera.
template <typename Get>
Key number_or_auto(Name name, Unit unit, Span span, Get field) {
  return number_or(Value(std::string("auto")), name, unit, span, field);
}

template <typename Get>
Key yes_or_no(Name name, Get field) {
  return {name.section,
          name.name,
          name.sentence,
          "true or false",
          [=](const Config& config) -> Value { return field(config); },
          [=](Config& config, const Value& value) {
            const bool* given = std::get_if<bool>(&value);
            if (given != nullptr) field(config) = *given;
            return given != nullptr;
          }};
}

// `is_good` judges the text; `wants` says what it passes.
template <typename Get>
Key text(Name name, std::string wants, bool (*is_good)(const std::string&), Get field) {
  return {name.section,
          name.name,
          name.sentence,
          std::move(wants),
          [=](const Config& config) -> Value { return field(config); },
          [=](Config& config, const Value& value) {
            const std::string* given = std::get_if<std::string>(&value);
            if (given == nullptr || !is_good(*given)) return false;
            field(config) = *given;
            return true;
          }};
}

// One of a few words, each with what it stands for.
template <typename Field>
using Words = std::vector<std::pair<std::string, Field>>;

template <typename Field>
std::string one_of(const Words<Field>& words) {
  std::string text;
  for (std::size_t i = 0; i < words.size(); ++i) {
    if (i > 0) text += i + 1 == words.size() ? " or " : ", ";
    text += '"' + words[i].first + '"';
  }
  return text;
}

template <typename Get>
Key choice(Name name, const Words<FieldOf<Get>>& words, Get field) {
  return {name.section,
          name.name,
          name.sentence,
          one_of(words),
          [=](const Config& config) -> Value {
            for (const auto& [word, meaning] : words) {
              if (meaning == field(config)) return word;
            }
            return {};
          },
          [=](Config& config, const Value& value) {
            for (const auto& [word, meaning] : words) {
              if (value != Value(word)) continue;
              field(config) = meaning;
              return true;
            }
            return false;
          }};
}

}  // namespace plumbline::config
