// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

#include "edge/base/exposure_timing.h"
#include "edge/base/time.h"

namespace plumbline::timing {

// What instant a camera's time stamp is of.
enum class FrameStamp {
  kExposureStart,  // V4L2 TSTAMP_SRC_SOE; UVC. Of the first row.
  kReadoutStart,   // libcamera SensorTimestamp: the first row's exposure has just ended
  kFrameEnd        // V4L2 TSTAMP_SRC_EOF: the last row has been read out
};

// What is known of a frame; what is not known is empty.
struct FrameFacts {
  HostTime stamp;
  FrameStamp kind = FrameStamp::kExposureStart;
  int rows = 0;
  std::optional<std::chrono::nanoseconds> exposure;
  std::optional<std::chrono::nanoseconds> row_time;  // 0: global shutter
  // Bounds on the two, where they are not known: a shutter is open, and read out, at most for so
  // long. The frame interval is one.
  std::chrono::nanoseconds longest = std::chrono::milliseconds(33);
  // From the instant that is stamped to the stamp (interrupt, USB), and its sigma.
  std::chrono::nanoseconds delay{};
  std::chrono::nanoseconds delay_sigma = std::chrono::microseconds(200);
};

// When light fell on the frame. An exposure not known is taken as evenly likely from 0 to the
// bound; so is the readout's duration, for a row that is anywhere in the frame. Their spreads are
// in sigma, and the means in `first_row_start` and `exposure`, so that the middle is without bias.
// Sources of what the stamps mean: the V4L2 documentation of buffer flags; picamera2 #821.
ExposureTiming exposure_of(const FrameFacts& facts);

}  // namespace plumbline::timing
