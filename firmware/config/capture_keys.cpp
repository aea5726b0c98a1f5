// SPDX-License-Identifier: MIT
#include <algorithm>
#include <functional>

#include "firmware/config/agreement.h"
#include "firmware/config/make_key.h"
#include "firmware/config/section_keys.h"

namespace plumbline::config {
namespace {

constexpr Span kHeight{1, 5'000};

bool is_heights(const std::vector<double>& list) {
  return list.size() <= kMostHeights &&
         std::ranges::adjacent_find(list, std::greater_equal<>()) == list.end() &&
         std::ranges::all_of(list, [](double h) { return h >= kHeight.low && h <= kHeight.high; });
}

bool put_heights(Config& config, const Value& value) {
  const auto* list = std::get_if<std::vector<double>>(&value);
  if (list == nullptr || !is_heights(*list)) return false;
  config.heights.list_m = *list;
  return true;
}

Key heights_list() {
  return {"capture",
          "heights_m",
          "The heights themselves, such as [30, 40, 60]; where any are given, they stand instead "
          "of first_m, last_m and step_m.",
          "a list of at most 500 metres from 1 to 5000, each larger than the one before",
          [](const Config& config) -> Value { return config.heights.list_m; },
          put_heights};
}

std::vector<Key> height_keys() {
  return {
      number({"capture", "first_m", "The lowest height of a photo, above the take-off point."},
             kMetres, kHeight, PLUMBLINE_FIELD(heights.first_m)),
      number(
          {"capture", "last_m", "The highest: the last photo is at the last step at or below it."},
          kMetres, kHeight, PLUMBLINE_FIELD(heights.last_m)),
      number({"capture", "step_m", "From one height to the next."}, kMetres, {0.1, 1'000},
             PLUMBLINE_FIELD(heights.step_m)),
      heights_list(),
      choice({"capture", "direction", "On the way up, down, or both."},
             {{"up", capture::Direction::kUp},
              {"down", capture::Direction::kDown},
              {"both", capture::Direction::kBoth}},
             PLUMBLINE_FIELD(capture.plan.direction)),
  };
}

std::vector<Key> other_keys() {
  return {
      number_or_none({"capture", "aside_m",
                      "Side-step: a photo so far beside the last one, too, once the lowest height "
                      "is reached; 0: none."},
                     kMetres, {0.5, 1'000}, PLUMBLINE_FIELD(capture.plan.aside_m)),
      number({"capture", "most_aside",
              "How many side-step photos one flight takes at most; the way home needs none."},
             kPlain, {0, 10'000}, PLUMBLINE_FIELD(capture.plan.most_aside)),
      number_or_none({"capture", "every_s", "Grid flights: a photo by time; 0: none."}, kSeconds,
                     {0.2, 3'600}, PLUMBLINE_FIELD(capture.plan.every)),
      number_or_none({"capture", "every_m", "Grid flights: a photo by distance flown; 0: none."},
                     kMetres, {0.5, 10'000}, PLUMBLINE_FIELD(capture.plan.every_m)),
      number({"capture", "grid_from_m",
              "Photos by time or distance are taken only above this height."},
             kMetres, {0, 5'000}, PLUMBLINE_FIELD(capture.plan.grid_from_m)),
      number({"capture", "reckon_for_s",
              "Without usable height it goes on by the last climb rate, for so long at most."},
             kSeconds, {0, 60}, PLUMBLINE_FIELD(capture.plan.reckon_for)),
      number_or_none(
          {"capture", "blind_every_s",
           "After that it goes on by time until there is a height again, each photo marked; "
           "0: no photo."},
          kSeconds, {0.2, 600}, PLUMBLINE_FIELD(capture.plan.blind_every)),
  };
}

std::vector<Key> take_off_keys() {
  return {
      choice(
          {"take_off", "by",
           "What begins and ends a flight: \"height\" of the receiver; \"pilot\": the autopilot is "
           "armed; \"relative_altitude\": its height above where it was armed, by rise_m and "
           "landed_below_m. The last two need the link of [pilot]; while no autopilot is heard, "
           "the receiver's height decides."},
          {{"height", capture::TakeOffBy::kHeight},
           {"pilot", capture::TakeOffBy::kArmed},
           {"relative_altitude", capture::TakeOffBy::kRelativeAltitude}},
          PLUMBLINE_FIELD(capture.take_off.by)),
      number({"take_off", "rise_m",
              "A flight begins when the drone has been so far above the ground, and three "
              "sigmas of its height, for rise_lasts_s."},
             kMetres, {0.5, 100}, PLUMBLINE_FIELD(capture.take_off.rise_m)),
      number({"take_off", "rise_lasts_s", "How long it must have been above rise_m."}, kSeconds,
             {0, 60}, PLUMBLINE_FIELD(capture.take_off.rise_lasts)),
      number({"take_off", "landed_below_m",
              "A flight ends when the drone has been below this height for landed_lasts_s."},
             kMetres, {0, 100}, PLUMBLINE_FIELD(capture.take_off.landed_below_m)),
      number({"take_off", "landed_lasts_s", "How long it must have been below landed_below_m."},
             kSeconds, {0, 600}, PLUMBLINE_FIELD(capture.take_off.landed_lasts)),
  };
}

std::vector<Key> stillness_keys() {
  return {
      number({"stillness", "paused_below_m_s",
              "The pilot pauses when the climb has been slower than this for paused_after_s."},
             kMetresPerSecond, {0.01, 5}, PLUMBLINE_FIELD(capture.stillness.paused_below_m_s)),
      number({"stillness", "paused_after_s", "How long the climb must have been that slow."},
             kSeconds, {0, 60}, PLUMBLINE_FIELD(capture.stillness.paused_after)),
      number({"stillness", "within_m",
              "A pause is for a photo when it is so near to a height that has none yet."},
             kMetres, {0, 50}, PLUMBLINE_FIELD(capture.stillness.within_m)),
      number({"stillness", "still_below_m_s",
              "At rest means slower than this in every direction for still_for_s."},
             kMetresPerSecond, {0.01, 5}, PLUMBLINE_FIELD(capture.stillness.still_below_m_s)),
      number({"stillness", "still_for_s",
              "How long the drone must have been at rest before the photo is taken."},
             kSeconds, {0, 60}, PLUMBLINE_FIELD(capture.stillness.still_for)),
      number({"stillness", "wait_at_most_s",
              "The longest wait for rest; then the photo is taken all the same."},
             kSeconds, {0, 60}, PLUMBLINE_FIELD(capture.stillness.wait_at_most)),
  };
}

}  // namespace

std::vector<Key> capture_keys() {
  std::vector<Key> all = height_keys();
  for (const auto& part : {other_keys(), take_off_keys(), stillness_keys()}) {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}  // namespace plumbline::config
