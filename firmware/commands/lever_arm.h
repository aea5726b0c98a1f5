// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/orient/problem.h"

namespace plumbline::commands {

// "R,U,B[,SIGMA]", antenna minus camera in metres. In the photo's frame (`frame` "photo") right, up
// and back are its x, y and z. In the airframe's ("body") they are its right side, its upside and
// its tail: the camera hangs under it looking down, so the photo's y is the airframe's nose; how
// far the airframe leans is not known and adds 5 degrees times the arm to the sigma. Needs photos
// that state their attitude then.
Result<orient::LeverArm> parse_lever_arm(const std::string& text, const std::string& frame,
                                         const std::vector<orient::Photo>& photos);

}  // namespace plumbline::commands
