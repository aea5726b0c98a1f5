// SPDX-License-Identifier: MIT
#include "edge/timing/exposure_time.h"

#include <cmath>

namespace plumbline::timing {
namespace {

using std::chrono::nanoseconds;

// u R for a row u and a readout R, both even from 0 to their bound: mean 1/4, variance
// 1/9 - 1/16 of the bound.
constexpr double kReadoutSigma = 0.2205;
// Half of an exposure that is even from 0 to its bound.
constexpr double kHalfExposureSigma = 0.1443;

double share_of(nanoseconds bound, double share) {
  return static_cast<double>(bound.count()) * share;
}

}  // namespace

ExposureTiming exposure_of(const FrameFacts& facts) {
  ExposureTiming timing;
  timing.exposure = facts.exposure.value_or(facts.longest / 2);
  timing.row_time = facts.row_time.value_or(nanoseconds(0));
  const double exposure_ns = facts.exposure ? 0 : share_of(facts.longest, kHalfExposureSigma);
  const double readout_ns = facts.row_time ? 0 : share_of(facts.longest, kReadoutSigma);
  const auto delay_ns = static_cast<double>(facts.delay_sigma.count());
  timing.sigma = nanoseconds(std::llround(std::hypot(exposure_ns, readout_ns, delay_ns)));

  const HostTime instant = facts.stamp - facts.delay;
  const nanoseconds mean_shift = facts.row_time ? nanoseconds(0) : facts.longest / 4;
  switch (facts.kind) {
    case FrameStamp::kExposureStart:
      timing.first_row_start = instant + mean_shift;
      break;
    case FrameStamp::kReadoutStart:
      timing.first_row_start = instant - timing.exposure + mean_shift;
      break;
    case FrameStamp::kFrameEnd:
      timing.first_row_start =
          instant - facts.rows * timing.row_time - timing.exposure - mean_shift;
      break;
  }
  return timing;
}

}  // namespace plumbline::timing
