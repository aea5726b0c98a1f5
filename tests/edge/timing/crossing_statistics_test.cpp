// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cstdio>
#include <optional>
#include <vector>

#include "edge/timing/crossing.h"
#include "tests/edge/timing/coverage.h"
#include "tests/edge/timing/simulated_climb.h"

namespace plumbline::timing {
namespace {

const Eigen::Vector3d kSigma_m{0.01, 0.01, 0.02};

// Two fifths of the variance are an offset, two fifths drift over 30 s, a fifth is white.
sim::GnssErrorSigmas error_sigmas() {
  sim::GnssErrorSigmas sigmas;
  sigmas.offset = {0.01 * std::sqrt(0.4), 0.02 * std::sqrt(0.4)};
  sigmas.correlated = sigmas.offset;
  sigmas.white = {0.01 * std::sqrt(0.2), 0.02 * std::sqrt(0.2)};
  return sigmas;
}

// When a climb first is at a height, or at a distance in plan from its foot.
std::optional<double> truth_s(const SimulatedClimb& climb, bool in_plan, double wanted_m) {
  for (double t_s = 0; t_s < 60; t_s += 0.001) {
    const Eigen::Vector3d at_m = climb.at(t_s);
    if ((in_plan ? at_m.head<2>().norm() : at_m.z()) >= wanted_m) return t_s;
  }
  return std::nullopt;
}

std::optional<Crossing> foreseen(const AntennaPredictor& antenna, bool in_plan, double wanted_m,
                                 double newest_s) {
  const GpsTime newest = kGpsStart + of_seconds(newest_s);
  const auto within = std::chrono::milliseconds(300);
  const geodesy::Geodetic foot = climb_frame().origin();
  if (in_plan) return crossing_of_distance(antenna, foot, wanted_m, newest, within);
  return crossing_of_height(antenna, foot.height_ellipsoidal_m + wanted_m, newest, within);
}

// Fix by fix, as a trigger does: what is foreseen when the step first lies within 300 ms.
void add_flight(double rate_hz, double climb_m_s, bool in_plan, std::uint64_t seed,
                Coverage& coverage) {
  sim::Random random(seed, 81);
  const SimulatedClimb climb(climb_m_s, 60, 0.3, random);
  const double wanted_m = in_plan ? random.uniform(2, 6) : random.uniform(5, 15) * climb_m_s;
  const auto truth = truth_s(climb, in_plan, wanted_m);
  if (!truth) return;
  std::vector<double> times_s;
  for (double t_s = random.uniform(); t_s < 60; t_s += 1 / rate_hz) times_s.push_back(t_s);
  const auto errors_m = sim::gnss_errors(error_sigmas(), times_s, random);
  AntennaPredictor antenna;
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    antenna.add(fix_at(times_s[k], climb.at(times_s[k]) + errors_m[k], kSigma_m));
    const auto crossing = foreseen(antenna, in_plan, wanted_m, times_s[k]);
    if (!crossing || times_s[k] < 3) continue;
    coverage.add(as_seconds(crossing->time - kGpsStart) - *truth, as_seconds(crossing->sigma));
    return;
  }
}

class CrossingStatistics : public testing::TestWithParam<bool> {};

// A few climbs stop just short of the height and go on seconds later: the RMS is theirs.
TEST_P(CrossingStatistics, AreForeseenAsWellAsTheySay) {
  if (PLUMBLINE_SANITIZED) GTEST_SKIP() << "statistics take too long under sanitizers";
  const std::vector<double> climbs_m_s = GetParam() ? std::vector{3.0} : std::vector{1.0, 3.0, 5.0};
  std::puts("what      rate   climb   flights  rms, mean sigma (ms)  within 1, 2 sigma (%)");
  for (const double rate_hz : {5.0, 10.0}) {
    for (const double climb_m_s : climbs_m_s) {
      Coverage c;
      for (std::uint64_t flight = 0; flight < 200; ++flight) {
        add_flight(rate_hz, climb_m_s, GetParam(), flight, c);
      }
      std::printf("%-8s  %2.0f Hz  %g m/s  %4d  %7.1f %7.1f  %5.1f %5.1f\n",
                  GetParam() ? "distance" : "height", rate_hz, climb_m_s, c.count, 1e3 * c.rms(),
                  1e3 * c.mean_sigma(), c.percent_in_one(), c.percent_in_two());
      EXPECT_GE(c.count, 100);
      expect_covered(c);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Of, CrossingStatistics, testing::Bool(),
                         [](const auto& p) { return p.param ? "Distance" : "Height"; });

}  // namespace
}  // namespace plumbline::timing
