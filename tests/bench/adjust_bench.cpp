// SPDX-License-Identifier: MIT
// The adjustment of five photos and 2000 points beside Ceres on the same problem, in the same run.
// The two do not do the same: ours finds its own start, goes through its robust stages and computes
// the covariance; Ceres starts near the truth and only minimises. Read the ratio with that in mind.
#include <benchmark/benchmark.h>

#include <chrono>
#include <cstddef>

#include "edge/base/units.h"
#include "edge/orient/adjust.h"
#include "tests/bench/ceres_adjustment.h"
#include "tests/edge/orient/made_flight.h"

namespace plumbline::bench {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

orient::testing::MadeFlight five_photos() {
  orient::testing::FlightPlan plan;
  plan.heights_m = {70, 76, 83, 90};  // and the side-step
  plan.targets = 2000;
  return orient::testing::make_flight(plan, 1);
}

// Largest distance between the points of the two solutions: they must be of one problem.
double largest_difference_m(const orient::Solution& ours, const CeresState& theirs) {
  double largest = 0;
  for (std::size_t i = 0; i < theirs.points.size(); ++i) {
    if (!ours.points[i].measured) continue;
    const Eigen::Vector3d theirs_m(theirs.points[i].data());
    largest = std::max(largest, (ours.points[i].in_enu_m - theirs_m).norm());
  }
  return largest;
}

void AdjustFivePhotosOf2000PointsBesideCeres(benchmark::State& run) {
  const orient::testing::MadeFlight flight = five_photos();
  orient::Options options;
  options.rejection_sigma = 100;  // as Ceres, which keeps every observation
  double ours_s = 0;
  double ceres_s = 0;
  double difference_m = 0;
  int iterations = 0;
  for ([[maybe_unused]] auto _ : run) {
    Clock::time_point start = Clock::now();
    const auto ours = orient::adjust(flight.problem, options);
    ours_s += seconds_since(start);

    CeresState theirs = start_near_truth(flight);
    start = Clock::now();
    const bool converged =
        solve_with_ceres(flight.problem, options.tilt_sigma_deg * kRadPerDeg, theirs);
    ceres_s += seconds_since(start);
    if (!ours || !converged) {
      run.SkipWithError("one of the two found no solution");
      break;
    }
    difference_m = largest_difference_m(*ours, theirs);
    iterations = ours->summary.iterations;
  }
  run.counters["ours_over_ceres"] = ours_s / ceres_s;
  run.counters["our_iterations"] = iterations;
  run.counters["largest_difference_m"] = difference_m;
}
BENCHMARK(AdjustFivePhotosOf2000PointsBesideCeres)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace plumbline::bench

BENCHMARK_MAIN();
