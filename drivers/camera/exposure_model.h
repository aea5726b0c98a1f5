// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

#include "drivers/camera.h"
#include "drivers/camera/exposure_history.h"

namespace plumbline {

// What happened at the instant that a driver stamps on a frame.
enum class StampMeaning {
  kStartOfExposure,  // of the first row (V4L2: TSTAMP_SRC_SOE)
  kStartOfReadout,   // the first row's exposure ends (libcamera's SensorTimestamp)
  kEndOfFrame,       // the last pixel was received (V4L2: TSTAMP_SRC_EOF)
  kFirstPacket,      // its first bytes came over USB, up to a period after readout began
  kArrival           // the whole frame was handed to us, up to a period after its end
};

struct ExposureModel {
  StampMeaning meaning = StampMeaning::kArrival;
  std::chrono::nanoseconds period{};
  std::optional<ExposureHistory::Exposure> exposure;
  std::optional<std::chrono::nanoseconds> row_time;  // rolling shutter; 0: global, and known to be
  int rows = 0;
};

// The exposure of a frame stamped `stamp`. What is not known is taken as uniformly distributed
// between its bounds: its mean corrects the time, its standard deviation goes into sigma. The
// bounds: readout takes at most a period, exposure at most a period, a delay at most a period.
// Where the row time is not known, the timing is that of the middle row, for all rows.
ExposureTiming exposure_of(HostTime stamp, const ExposureModel& model);

}  // namespace plumbline
