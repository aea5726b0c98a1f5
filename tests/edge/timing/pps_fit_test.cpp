// SPDX-License-Identifier: MIT
#include "edge/timing/pps_fit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <vector>

#include "edge/timing/clock_fit.h"
#include "tests/edge/timing/simulated_arrivals.h"

namespace plumbline::timing {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

// A flight of epochs at 5 Hz and pulses. What goes wrong with the pulses, typed in.
struct PulseSetting {
  double jitter_s = 20e-6;   // exponential behind the pulse
  double late_share = 0.05;  // of the stamps, by up to 2 ms
  double missing_share = 0.05;
  double doubled_share = 0.05;  // a second edge, 30 us to 100 ms after
  double edge_after_s = 0;      // the wrong edge of a pulse: so much later
  double duration_s = 120;
};

struct Flight {
  ClockFit coarse;
  PpsFit pps;
  GpsTime end;
  HostTime end_truth;
};

std::vector<HostTime> stamps_of(HostTime truth, const PulseSetting& setting, sim::Random& random) {
  if (random.uniform() < setting.missing_share) return {};
  double late_s = setting.edge_after_s - setting.jitter_s * std::log(1 - random.uniform());
  if (random.uniform() < setting.late_share) late_s += random.uniform(0, 2e-3);
  std::vector<HostTime> stamps = {truth + of_seconds(late_s)};
  if (random.uniform() < setting.doubled_share) {
    stamps.push_back(stamps[0] + of_seconds(random.uniform(30e-6, 0.1)));
  }
  return stamps;
}

Flight flown(const PulseSetting& setting, std::uint64_t seed) {
  sim::Random random(seed, 46);
  ArrivalSetting arrivals;
  arrivals.duration_s = setting.duration_s;
  arrivals.crystal.rate = random.uniform(-100e-6, 100e-6);
  const auto epochs = simulated_epochs(arrivals, random);
  Flight flight;
  for (const SimulatedEpoch& e : epochs) {
    flight.coarse.add(e.epoch, e.arrival);
    if (e.epoch.time_since_epoch() % seconds(1) != nanoseconds(0)) continue;
    for (const HostTime stamp : stamps_of(e.truth, setting, random)) flight.pps.add_edge(stamp);
  }
  flight.end = epochs.back().epoch;
  flight.end_truth = epochs.back().truth;
  return flight;
}

TEST(PpsFit, KnowsTheClockToFiftyMicrosecondsWithASigmaThatCovers) {
  constexpr int kFlights = 300;
  std::puts("jitter (us)  rms, mean sigma (us)  within 1, 2 sigma (%)");
  for (const double jitter_s : {3e-6, 10e-6, 20e-6}) {
    int within_one = 0;
    int within_two = 0;
    double sum2 = 0;
    double sum_sigma_s = 0;
    for (std::uint64_t seed = 0; seed < kFlights; ++seed) {
      PulseSetting setting;
      setting.jitter_s = jitter_s;
      setting.duration_s = 60;
      const Flight flight = flown(setting, seed);
      const auto clock = flight.pps.estimate(flight.coarse.estimate());
      ASSERT_TRUE(clock) << seed;
      const auto host = clock->host_of(flight.end);
      const double error_s = as_seconds(host.time - flight.end_truth);
      const double sigma_s = std::hypot(as_seconds(host.sigma_fit), as_seconds(host.sigma_latency));
      sum2 += error_s * error_s;
      sum_sigma_s += sigma_s;
      within_one += std::abs(error_s) <= sigma_s ? 1 : 0;
      within_two += std::abs(error_s) <= 2 * sigma_s ? 1 : 0;
    }
    std::printf("%4.0f  %6.2f %6.2f  %5.1f %5.1f\n", 1e6 * jitter_s,
                1e6 * std::sqrt(sum2 / kFlights), 1e6 * sum_sigma_s / kFlights,
                100.0 * within_one / kFlights, 100.0 * within_two / kFlights);
    EXPECT_LE(std::sqrt(sum2 / kFlights), 50e-6);
    EXPECT_GE(within_one, 0.683 * kFlights - 3 * std::sqrt(0.683 * 0.317 * kFlights));
    EXPECT_GE(within_two, 0.954 * kFlights - 3 * std::sqrt(0.954 * 0.046 * kFlights));
  }
}

TEST(PpsFit, MeasuresTheLatencyThatArrivalsCannotTell) {
  const Flight flight = flown({}, 1);
  const auto latency = flight.pps.measured_latency(flight.coarse.estimate());
  ASSERT_TRUE(latency);
  EXPECT_NEAR(as_seconds(*latency), 0.080, 0.003);
}

TEST(PpsFit, SaysWhatIsMissingUntilItIsLocked) {
  PpsFit pps;
  const auto coarse = flown({}, 2).coarse.estimate();
  EXPECT_EQ(pps.state(coarse), PpsState::kNoPulses);
  for (int k = 0; k < 5; ++k) pps.add_edge(kHostStart + seconds(k));
  EXPECT_EQ(pps.state(std::nullopt), PpsState::kUnnumbered);
  EXPECT_FALSE(pps.estimate(std::nullopt));
}

TEST(PpsFit, FindsThatTheOtherEdgeOfThePulseIsStamped) {
  PulseSetting setting;
  setting.edge_after_s = 0.1;
  const Flight flight = flown(setting, 3);
  EXPECT_EQ(flight.pps.state(flight.coarse.estimate()), PpsState::kWrongEdge);
  EXPECT_FALSE(flight.pps.estimate(flight.coarse.estimate()));
}

TEST(PpsFit, KeepsCountAcrossMissingPulses) {
  sim::Random random(4, 47);
  PpsFit pps;
  const double rate = 73e-6;
  for (int k = 0; k <= 200; ++k) {
    if (k > 60 && k < 160) continue;
    pps.add_edge(kHostStart + of_seconds(k * (1 + rate) - 5e-6 * std::log(1 - random.uniform())));
  }
  EXPECT_EQ(pps.summary().restarts, 0u);
  EXPECT_EQ(pps.summary().used, 102u);
}

TEST(PpsFit, BeginsAnewWhereThePulsesGoOnElsewhere) {
  PpsFit pps;
  for (int k = 0; k < 30; ++k) pps.add_edge(kHostStart + seconds(k));
  for (int k = 30; k < 60; ++k) pps.add_edge(kHostStart + seconds(k) + milliseconds(300));
  EXPECT_EQ(pps.summary().restarts, 1u);
  GnssClock coarse;
  coarse.host = kHostStart + milliseconds(300);
  coarse.gps = kGpsStart;
  coarse.latency = milliseconds(80);
  ASSERT_TRUE(pps.estimate(coarse));
  const HostTime last = kHostStart + seconds(59) + milliseconds(300);
  EXPECT_LT(std::abs((pps.estimate(coarse)->host_of(kGpsStart + seconds(59)).time - last).count()),
            10000);
}

TEST(PpsFit, DoesNotLockToNoise) {
  sim::Random random(5, 48);
  PpsFit pps;
  HostTime time = kHostStart;
  for (int k = 0; k < 500; ++k) pps.add_edge(time += of_seconds(random.uniform(0.01, 2)));
  EXPECT_EQ(pps.state(std::nullopt), PpsState::kNoPulses);
}

}  // namespace
}  // namespace plumbline::timing
