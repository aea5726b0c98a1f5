// SPDX-License-Identifier: MIT
#include "firmware/deliver/labels.h"

#include <algorithm>
#include <array>

namespace plumbline::deliver {
namespace {

// Of the style's letters, in units of the view box.
constexpr double kLetterWidth = 7.6;
constexpr double kLetterHeight = 11.0;

struct LabelBox {
  Place low;
  Place high;

  bool covers(const Place& place) const {
    return (place.array() > low.array()).all() && (place.array() < high.array()).all();
  }
  bool meets(const LabelBox& other) const {
    return (low.array() < other.high.array()).all() && (other.low.array() < high.array()).all();
  }
};

struct Side {
  Place offset;  // of the foot of the first (or last) letter
  bool to_left;
};

constexpr double kAside = 5.0;
const std::array<Side, 4> kSides = {{{Place(kAside, -kAside), false},
                                     {Place(-kAside, -kAside), true},
                                     {Place(kAside, kAside + 9.0), false},
                                     {Place(-kAside, kAside + 9.0), true}}};

LabelBox box_of(const Place& foot, bool to_left, std::size_t letters) {
  const double width = kLetterWidth * static_cast<double>(letters);
  const Place low = foot - Place(to_left ? width : 0.0, kLetterHeight);
  return {low, low + Place(width, kLetterHeight)};
}

}  // namespace

int draw_labels(Svg& svg, const std::vector<Place>& places, const std::vector<std::string>& names) {
  std::vector<LabelBox> taken;
  int left_out = 0;
  const auto is_free = [&](const LabelBox& box) {
    const auto covers = [&](const Place& place) { return box.covers(place); };
    const auto meets = [&](const LabelBox& other) { return box.meets(other); };
    return std::none_of(places.begin(), places.end(), covers) &&
           std::none_of(taken.begin(), taken.end(), meets);
  };
  for (std::size_t i = 0; i < places.size(); ++i) {
    const auto side = std::find_if(kSides.begin(), kSides.end(), [&](const Side& candidate) {
      return is_free(box_of(places[i] + candidate.offset, candidate.to_left, names[i].size()));
    });
    if (side == kSides.end()) {
      ++left_out;
      continue;
    }
    const Place foot = places[i] + side->offset;
    taken.push_back(box_of(foot, side->to_left, names[i].size()));
    svg.text(foot, names[i], side->to_left ? "label halo end" : "label halo");
  }
  return left_out;
}

}  // namespace plumbline::deliver
