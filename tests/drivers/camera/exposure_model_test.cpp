// SPDX-License-Identifier: MIT
#include "drivers/camera/exposure_model.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace plumbline {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

const HostTime kStamp{milliseconds(1000)};

double ms_from_stamp(HostTime time) {
  return std::chrono::duration<double, std::milli>(time - kStamp).count();
}

ExposureModel known(StampMeaning meaning) {
  // 1001 rows of 20 us: 20 ms from the first to the last row.
  return {meaning, milliseconds(50), ExposureHistory::Exposure{milliseconds(4), {}},
          microseconds(20), 1001};
}

TEST(ExposureModel, PutsTheFirstRowWhereTheStampSaysItBegan) {
  const ExposureTiming timing = exposure_of(kStamp, known(StampMeaning::kStartOfExposure));
  EXPECT_NEAR(ms_from_stamp(timing.first_row_start), 0.0, 1e-6);
  EXPECT_NEAR(ms_from_stamp(timing.middle_of_row(500)), 12.0, 1e-6);
  EXPECT_LE(timing.sigma, microseconds(100));
}

TEST(ExposureModel, EndsTheFirstRowWhereReadoutBegins) {
  const ExposureTiming timing = exposure_of(kStamp, known(StampMeaning::kStartOfReadout));
  EXPECT_NEAR(ms_from_stamp(timing.middle_of_row(0)), -2.0, 1e-6);
}

TEST(ExposureModel, EndsTheLastRowWhereTheFrameEnds) {
  const ExposureTiming timing = exposure_of(kStamp, known(StampMeaning::kEndOfFrame));
  EXPECT_NEAR(ms_from_stamp(timing.middle_of_row(1000)), -2.0, 1e-6);
  EXPECT_EQ(timing.row_time, microseconds(20));
}

// Cameras drawn from everything that the model leaves open: the stated sigma must be what the
// middle of the middle row is off by, RMS, and its mean right.
struct Drawn {
  double stamp_after_middle_ms;
};

Drawn draw(StampMeaning meaning, std::mt19937& random, double period_ms) {
  std::uniform_real_distribution<double> upto(0.0, period_ms);
  const double readout = upto(random);
  const double exposure = upto(random);
  const double delay = upto(random);
  switch (meaning) {
    case StampMeaning::kStartOfExposure:  // rolling: the middle row begins half a readout later
      return {-(0.5 * exposure + 0.5 * readout)};
    case StampMeaning::kStartOfReadout:
      return {0.5 * exposure - 0.5 * readout};
    case StampMeaning::kFirstPacket:
      return {0.5 * exposure - 0.5 * readout + delay};
    case StampMeaning::kEndOfFrame:  // between rolling (half) and global (whole) readout
      return {0.5 * exposure + readout};
    case StampMeaning::kArrival:
      return {0.5 * exposure + readout + delay};
  }
  return {0};
}

TEST(ExposureModel, StatesTheSigmaOfWhatItDoesNotKnow) {
  for (const StampMeaning meaning :
       {StampMeaning::kStartOfExposure, StampMeaning::kStartOfReadout, StampMeaning::kFirstPacket,
        StampMeaning::kEndOfFrame, StampMeaning::kArrival}) {
    const ExposureTiming timing =
        exposure_of(kStamp, {meaning, milliseconds(40), std::nullopt, std::nullopt, 1000});
    std::mt19937 random(1);
    constexpr int kCameras = 20000;
    double sum = 0;
    double squares = 0;
    for (int i = 0; i < kCameras; ++i) {
      const double off = ms_from_stamp(timing.middle_of_row(0)) +
                         draw(meaning, random, 40.0).stamp_after_middle_ms;
      sum += off;
      squares += off * off;
    }
    const double sigma = std::chrono::duration<double, std::milli>(timing.sigma).count();
    EXPECT_NEAR(sum / kCameras, 0.0, 4 * sigma / std::sqrt(kCameras));
    EXPECT_NEAR(std::sqrt(squares / kCameras) / sigma, 1.0, 0.03);
  }
}

}  // namespace
}  // namespace plumbline
