// SPDX-License-Identifier: MIT
#include "edge/timing/exposure_time.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "tests/edge/timing/simulated_arrivals.h"

namespace plumbline::timing {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;

// A sensor: its first row begins to see at `start_s`.
struct TrueFrame {
  double start_s = 0;
  double exposure_s = 0;
  double row_time_s = 0;
  int rows = 3040;

  double middle_s(double row) const { return start_s + row * row_time_s + exposure_s / 2; }
  double stamp_s(FrameStamp kind) const {
    if (kind == FrameStamp::kExposureStart) return start_s;
    if (kind == FrameStamp::kReadoutStart) return start_s + exposure_s;
    return start_s + (rows - 1) * row_time_s + exposure_s + row_time_s;
  }
};

FrameFacts facts_of(const TrueFrame& frame, FrameStamp kind, double late_s) {
  FrameFacts facts;
  facts.kind = kind;
  facts.rows = frame.rows;
  facts.stamp = kHostStart + of_seconds(frame.stamp_s(kind) + late_s);
  facts.exposure = of_seconds(frame.exposure_s);
  facts.row_time = of_seconds(frame.row_time_s);
  return facts;
}

class StampKind : public testing::TestWithParam<FrameStamp> {};

TEST_P(StampKind, GivesTheMiddleToAMillisecondWhereAllIsKnown) {
  // IMX477: 28.5 us per row. The stamp is taken in an interrupt, 0.3 ms late on the average.
  sim::Random random(1, 49);
  for (int k = 0; k < 2000; ++k) {
    TrueFrame frame{k / 10.0, random.uniform(0.1e-3, 5e-3), 28.5e-6};
    FrameFacts facts = facts_of(frame, GetParam(), -0.3e-3 * std::log(1 - random.uniform()));
    facts.delay = microseconds(300);
    facts.delay_sigma = microseconds(300);
    const ExposureTiming timing = exposure_of(facts);
    EXPECT_EQ(timing.sigma, microseconds(300));
    for (const double row : {0.0, 1519.5, 3039.0}) {
      const double error_s =
          as_seconds(timing.middle_of_row(row) - kHostStart) - frame.middle_s(row);
      // An exponential of mean 0.3 ms is beyond 3 ms once in 22000.
      ASSERT_LE(std::abs(error_s), 3e-3);
    }
  }
}

TEST_P(StampKind, CoversWhatIsNotKnownByItsSigma) {
  constexpr int kFrames = 4000;
  const double longest_s = 33e-3;
  for (const bool exposure_known : {false, true}) {
    for (const bool row_time_known : {false, true}) {
      sim::Random random(2, 50);
      double sum = 0;
      double sum2 = 0;
      double sigma_s = 0;
      for (int k = 0; k < kFrames; ++k) {
        const double readout_s = random.uniform(0, longest_s);
        TrueFrame frame{k / 10.0, random.uniform(0, longest_s), readout_s / 1080, 1080};
        FrameFacts facts = facts_of(frame, GetParam(), 0.2e-3 * random.normal());
        facts.longest = of_seconds(longest_s);
        if (!exposure_known) facts.exposure.reset();
        if (!row_time_known) facts.row_time.reset();
        const ExposureTiming timing = exposure_of(facts);
        const double row = random.uniform(0, 1079);
        const double error_s =
            as_seconds(timing.middle_of_row(row) - kHostStart) - frame.middle_s(row);
        sum += error_s;
        sum2 += error_s * error_s;
        sigma_s = as_seconds(timing.sigma);
      }
      const double rms_s = std::sqrt(sum2 / kFrames);
      EXPECT_NEAR(rms_s / sigma_s, 1, 0.05) << exposure_known << row_time_known;
      EXPECT_LE(std::abs(sum / kFrames), 4 * sigma_s / std::sqrt(kFrames));
      if (exposure_known && row_time_known) {
        EXPECT_LE(rms_s, 1e-3);
      }
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Kind, StampKind,
                         testing::Values(FrameStamp::kExposureStart, FrameStamp::kReadoutStart,
                                         FrameStamp::kFrameEnd),
                         [](const auto& p) -> std::string {
                           if (p.param == FrameStamp::kExposureStart) return "ExposureStart";
                           return p.param == FrameStamp::kReadoutStart ? "ReadoutStart"
                                                                       : "FrameEnd";
                         });

TEST(ExposureTime, IsCentredHalfAnExposureBeforeLibcamerasSensorTimestamp) {
  FrameFacts facts;
  facts.stamp = kHostStart;
  facts.kind = FrameStamp::kReadoutStart;
  facts.rows = 3040;
  facts.exposure = milliseconds(2);
  facts.row_time = nanoseconds(28500);
  EXPECT_EQ(exposure_of(facts).middle_of_row(1000),
            kHostStart - milliseconds(1) + nanoseconds(28500000));
}

}  // namespace
}  // namespace plumbline::timing
