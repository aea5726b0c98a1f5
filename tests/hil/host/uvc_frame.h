// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/base/image.h"
#include "tests/hil/host/uvc_camera.h"

namespace plumbline::hil {

// One channel of three.
Image grey_of(const Image& colour);

// A frame of YUY2, full range, with the mark of exposure_mark.h: a grey picture, enlarged about its
// middle by whole pixels (1: as it is), as bright as exposure and gain make it. An exposure of 2 ms
// at a gain of 10 is as the sun shows the ground; automatic is always so.
std::string uvc_frame(const Image& grey, double enlarged, const UvcExposure& exposure);

}  // namespace plumbline::hil
