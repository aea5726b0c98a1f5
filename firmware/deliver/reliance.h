// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

// How far one quantity common to the whole may be relied upon, and what it rests on.
enum class Trust {
  kFixed,         // adds little to the sigma of a point by itself
  kRelativeOnly,  // known, but so much worse than the shape that it governs absolute figures
  kNotFixed       // named in Summary::unobservable, or without any bound
};

struct Reliance {
  std::string quantity;  // "Position", "Azimuth", "Scale", ...
  std::string sigma;     // in words: "0.32 deg", "not fixed"
  std::string rests_on;  // "GNSS positions alone", "known lengths", ...
  Trust trust = Trust::kFixed;
  std::string meaning;  // a sentence: what this does to coordinates, lengths, heights
};

// Position, azimuth, tilt, scale, focal length and height of the whole, in this order.
std::vector<Reliance> reliances(const Product& product);

// The sentences of those that are not fixed by more than the whole's own weak reference: which
// figures hold only relative to each other.
std::vector<std::string> relative_only(const Product& product);

}  // namespace plumbline::deliver
