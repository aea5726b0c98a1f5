// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "firmware/deliver/svg.h"

namespace plumbline::deliver {

// Writes names beside places so that none covers another or a place: right above, left above,
// right below or left below, the first that is free. Returns how many found no room and were left
// out.
int draw_labels(Svg& svg, const std::vector<Place>& places, const std::vector<std::string>& names);

}  // namespace plumbline::deliver
