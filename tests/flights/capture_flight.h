// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "edge/capture/decider.h"
#include "sim/climb_path.h"
#include "sim/gnss_stream.h"

namespace plumbline::flights {

// A flight of which only the decisions matter: no pictures, no disk.
struct CaptureFlight {
  std::uint64_t seed = 1;
  sim::ClimbPathOptions path;
  sim::GnssStreamOptions receiver;
  bool pulses_per_second = true;
  capture::CaptureOptions options;
  double camera_delay_s = 0.1;                           // pulse to middle of the exposure,
  double camera_jitter_s = 0.0025;                       // 1 sigma
  double frames_per_s = 10;                              // of a camera that runs freely
  std::vector<std::pair<double, double>> camera_gone_s;  // from, until: no frames, no answers
};

struct CapturedPhoto {
  capture::PhotoTaken taken;
  Eigen::Vector3d place_m;  // where the antenna truly was in the middle of the exposure
};

struct CaptureLog {
  std::vector<CapturedPhoto> photos;
  std::vector<capture::PhotoMissed> missed;
  std::vector<capture::Phase> phases;
  std::vector<capture::Input> inputs;
  std::vector<capture::Decision> decisions;
  std::vector<bool> entries_taken;
};

// Flies it, from the ground to the ground. The same flight gives the same log.
CaptureLog fly(const CaptureFlight& flight);

}  // namespace plumbline::flights
