// SPDX-License-Identifier: MIT
#include "edge/timing/clock_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

#include "edge/timing/envelope.h"
#include "tests/edge/timing/simulated_arrivals.h"

namespace plumbline::timing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

double error_s(const ClockFit& fit, const SimulatedEpoch& at) {
  return as_seconds(fit.estimate()->host_of(at.epoch).time - at.truth);
}

std::vector<SimulatedEpoch> epochs_of(const ArrivalSetting& setting, std::uint64_t seed) {
  sim::Random random(seed, 42);
  return simulated_epochs(setting, random);
}

TEST(GnssClock, GoesToTheHostClockAndBackWithoutLosingANanosecond) {
  GnssClock clock;
  clock.host = kHostStart;
  clock.gps = kGpsStart;
  clock.rate = 87.5e-6;
  for (const auto after : {seconds(-3600), seconds(0), seconds(1), seconds(86400)}) {
    const auto host = clock.host_of(kGpsStart + after);
    // 87.5 us per second, by hand.
    EXPECT_EQ((host.time - kHostStart - after).count(), 87500 * after.count());
    EXPECT_LE(std::abs((clock.gps_of(host.time).time - kGpsStart - after).count()), 1);
  }
}

TEST(LowerEnvelope, LiesJustBelowTheBestOfAllLinesUnderThePoints) {
  // The linear programme of Moon et al., by brute force: of all lines through two points that no
  // point is below, the one with the least sum of distances.
  sim::Random random(1, 43);
  std::vector<DelayPoint> points;
  for (int k = 0; k < 120; ++k) {
    const double t = 2.0 * (k - 119);
    points.push_back({t, 60e-6 * t + sim::jitter_s(sim::JitterLaw::kExponential, random)});
  }
  double least_sum = std::numeric_limits<double>::infinity();
  DelayPoint best;  // value at time 0 and slope
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t j = i + 1; j < points.size(); ++j) {
      const double slope =
          (points[j].delay_s - points[i].delay_s) / (points[j].time_s - points[i].time_s);
      const double value = points[i].delay_s - slope * points[i].time_s;
      double sum = 0;
      double lowest = 0;
      for (const DelayPoint& p : points) {
        sum += p.delay_s - value - slope * p.time_s;
        lowest = std::min(lowest, p.delay_s - value - slope * p.time_s);
      }
      if (lowest < -1e-12 || sum >= least_sum) continue;
      least_sum = sum;
      best = {slope, value};
    }
  }
  const Envelope found = lower_envelope(points, 1e-3);  // a prior too wide to matter
  EXPECT_LE(std::abs(found.slope - best.time_s), 3 * std::sqrt(found.slope_variance));
  EXPECT_LE(found.value_s, best.delay_s + std::sqrt(found.variance_s2));
  EXPECT_GE(found.value_s, best.delay_s - 3 * std::sqrt(found.variance_s2));
  EXPECT_LT(std::sqrt(found.variance_s2), 2e-3);
}

TEST(ClockFit, HasNothingToSayBeforeThreeEpochs) {
  ClockFit fit;
  EXPECT_FALSE(fit.estimate());
  const auto epochs = epochs_of({}, 1);
  fit.add(epochs[0].epoch, epochs[0].arrival);
  fit.add(epochs[1].epoch, epochs[1].arrival);
  EXPECT_FALSE(fit.estimate());
  fit.add(epochs[2].epoch, epochs[2].arrival);
  EXPECT_TRUE(fit.estimate());
}

TEST(ClockFit, KeepsTheSigmaOfTheLeastLatencyApart) {
  ClockFitOptions options;
  options.latency = {milliseconds(100), milliseconds(7)};
  ClockFit fit(options);
  const auto epochs = epochs_of({}, 2);
  for (const auto& e : epochs) fit.add(e.epoch, e.arrival);
  const auto host = fit.estimate()->host_of(epochs.back().epoch);
  EXPECT_EQ(host.sigma_latency, milliseconds(7));
  EXPECT_LT(host.sigma_fit, milliseconds(5));
  // The receiver's least latency is 80 ms, so the clock is early by what was assumed too much.
  EXPECT_NEAR(error_s(fit, epochs.back()), -0.020, 0.003);
}

TEST(ClockFit, FollowsACrystalThatWarmsUp) {
  // 20 ppm at the start, 2 ppm more each minute: typed in.
  ClockFit fit;
  sim::Random random(3, 44);
  for (int k = 0; k < 5 * 900; ++k) {
    const double t = 0.2 * k;
    const HostTime truth = kHostStart + of_seconds(t + 20e-6 * t + 0.5 * 2e-6 / 60 * t * t);
    const double late_s = 0.080 + sim::jitter_s(sim::JitterLaw::kExponential, random);
    const GpsTime epoch = kGpsStart + of_seconds(t);
    fit.add(epoch, truth + of_seconds(late_s));
    if (k % 500 != 499) continue;
    const auto host = fit.estimate()->host_of(epoch);
    EXPECT_LT(std::abs(as_seconds(host.time - truth)), 5e-3) << t;
  }
}

TEST(ClockFit, GoesOnAcrossAGapOfTenMinutes) {
  ArrivalSetting setting;
  setting.duration_s = 1000;
  const auto epochs = epochs_of(setting, 4);
  ClockFit fit;
  for (const auto& e : epochs) {
    const auto since = e.epoch - kGpsStart;
    if (since < seconds(300) || since > seconds(900)) fit.add(e.epoch, e.arrival);
    if (since == seconds(899)) {
      const auto host = fit.estimate()->host_of(e.epoch);
      EXPECT_LT(std::abs(as_seconds(host.time - e.truth)), 3 * as_seconds(host.sigma_fit));
      EXPECT_LT(host.sigma_fit, milliseconds(5));
    }
  }
  EXPECT_EQ(fit.summary().steps, 0u);
  EXPECT_LT(std::abs(error_s(fit, epochs.back())), 3e-3);
}

TEST(ClockFit, LeavesOutRepeatedLateAndDisorderedEpochs) {
  auto epochs = epochs_of({}, 5);
  ClockFit fit;
  for (std::size_t k = 0; k < epochs.size(); ++k) {
    fit.add(epochs[k].epoch, epochs[k].arrival);
    if (k % 7 == 0) fit.add(epochs[k].epoch, epochs[k].arrival + milliseconds(3));
    if (k % 11 == 0 && k > 0) fit.add(epochs[k - 1].epoch, epochs[k].arrival + milliseconds(60));
    if (k % 50 == 0 && k > 9) fit.add(epochs[k - 9].epoch, epochs[k].arrival + milliseconds(9));
  }
  EXPECT_GT(fit.summary().repeated, 200u);
  EXPECT_GT(fit.summary().late, 30u);
  EXPECT_EQ(fit.summary().steps, 0u);
  EXPECT_LT(std::abs(error_s(fit, epochs.back())), 2e-3);
}

TEST(ClockFit, IsNotMovedByOneEpochWithAWrongTime) {
  const auto epochs = epochs_of({}, 6);
  ClockFit fit;
  ClockFit undisturbed;
  for (std::size_t k = 0; k < epochs.size(); ++k) {
    const auto off = k == 1500 ? seconds(3600) : k == 2000 ? seconds(-80) : seconds(0);
    EXPECT_FALSE(fit.add(epochs[k].epoch + off, epochs[k].arrival));
    undisturbed.add(epochs[k].epoch, epochs[k].arrival);
  }
  EXPECT_EQ(fit.summary().early, undisturbed.summary().early + 1);
  EXPECT_EQ(fit.summary().late, undisturbed.summary().late + 1);
  EXPECT_LT(std::abs(error_s(fit, epochs.back())), 2e-3);
}

class ReceiverStep : public testing::TestWithParam<int> {};

TEST_P(ReceiverStep, IsFoundToldAndFollowed) {
  const auto epochs = epochs_of({}, 7);
  const auto jump = seconds(GetParam());
  ClockFit fit;
  int told = 0;
  GpsTime told_at;
  for (const auto& e : epochs) {
    const bool after = e.epoch - kGpsStart >= seconds(300);
    const GpsTime epoch = after ? e.epoch + jump : e.epoch;
    if (fit.add(epoch, e.arrival)) {
      ++told;
      told_at = e.epoch;
    }
  }
  EXPECT_EQ(told, 1);
  EXPECT_LT(told_at - kGpsStart, seconds(312));
  EXPECT_NEAR(as_seconds(fit.summary().last_step), -GetParam(), 0.05);
  const auto host = fit.estimate()->host_of(epochs.back().epoch + jump);
  EXPECT_LT(std::abs(as_seconds(host.time - epochs.back().truth)), 3e-3);
}

INSTANTIATE_TEST_SUITE_P(Seconds, ReceiverStep, testing::Values(-18, -1, 1, 18), [](const auto& p) {
  return (p.param < 0 ? "Back" : "Ahead") + std::to_string(std::abs(p.param));
});

TEST(ClockFit, DoesNotTakeAStallOfTheComputerForAStep) {
  const auto epochs = epochs_of({}, 8);
  ClockFit fit;
  for (const auto& e : epochs) {
    const auto since = e.epoch - kGpsStart;
    const bool stalled = since > seconds(200) && since < seconds(220);
    const HostTime read = stalled ? kHostStart + seconds(220) : e.arrival;
    EXPECT_FALSE(fit.add(e.epoch, std::max(read, e.arrival)));
  }
  EXPECT_LT(std::abs(error_s(fit, epochs.back())), 2e-3);
}

TEST(ClockFit, BeginsAnewAfterTheHostSlept) {
  const auto epochs = epochs_of({}, 9);
  ClockFit fit;
  const auto slept = seconds(40);  // the host clock stands still meanwhile
  for (const auto& e : epochs) {
    const auto since = e.epoch - kGpsStart;
    if (since < seconds(100)) fit.add(e.epoch, e.arrival);
    if (since > seconds(140)) fit.add(e.epoch, e.arrival - slept);
  }
  EXPECT_EQ(fit.summary().steps, 1u);
  EXPECT_LT(std::abs(as_seconds(fit.estimate()->host_of(epochs.back().epoch).time -
                                (epochs.back().truth - slept))),
            3e-3);
}

TEST(ClockFit, SaysThatRoundedTimeStampsAreLessCertain) {
  // A receiver whose epochs fall anywhere; NMEA writes hundredths.
  sim::Random random(10, 45);
  ClockFit fit;
  GpsTime last;
  HostTime truth;
  for (int k = 0; k < 1500; ++k) {
    const auto since = of_seconds(k * 0.1917);
    truth = kHostStart + since;
    last = kGpsStart + std::chrono::round<std::chrono::duration<std::int64_t, std::centi>>(since);
    fit.add(last, truth + of_seconds(0.08 + sim::jitter_s(sim::JitterLaw::kExponential, random)));
  }
  const auto host = fit.estimate()->host_of(kGpsStart + (truth - kHostStart));
  EXPECT_GE(host.sigma_fit, milliseconds(3));
  EXPECT_LT(std::abs(as_seconds(host.time - truth)), 5e-3);
}

}  // namespace
}  // namespace plumbline::timing
