// SPDX-License-Identifier: MIT
// The adjustment beside Ceres: the same least squares problem from the same start to the same final
// cost (checked to 1e-9), one thread each, turn by turn in one run; building the problem is not
// timed on either side. Times are medians of processor time; a ratio is theirs over ours, larger =
// ours is faster.
//
//   cmake --preset bench && cmake --build --preset bench --target adjust_bench adjust_once
//   build/bench/tests/bench/adjust_bench
//
// Instruction counts, which no other load disturbs: see adjust_once.cpp.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <functional>
#include <string>
#include <vector>

#include "edge/orient/precision/covariance.h"
#include "tests/bench/ceres_adjustment.h"
#include "tests/bench/made_block.h"

namespace plumbline::bench {
namespace {

// Of the processor: what else runs on the machine disturbs it less than it does a clock.
double seconds(const std::function<void()>& work) {
  const std::clock_t start = std::clock();
  work();
  return static_cast<double>(std::clock() - start) / CLOCKS_PER_SEC;
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  return values[values.size() / 2];
}

constexpr double kSameCost = 1e-9;

// Our side of a comparison: a block, its network, and the minimum that its azimuth prior holds on
// to, so that it counts for nothing there.
struct Ours {
  explicit Ours(MadeBlock made)
      : block(std::move(made)),
        network(network_of(block)),
        settled(minimum_of(block, network, block.start).state) {}

  orient::Minimum solve() const { return minimum_of(block, network, settled); }

  MadeBlock block;
  orient::Network network;
  orient::State settled;
};

bool same_cost(double ours, double theirs) { return std::abs(ours - theirs) <= kSameCost * ours; }

// `repetitions` solves of each, in turns.
void solve_beside_ceres(benchmark::State& run, const Ours& ours, Derivatives derivatives,
                        ceres::LinearSolverType solver, int repetitions) {
  CeresAdjustment ceres_side(ours.block, derivatives);
  std::vector<double> ours_s, ceres_s;
  orient::Minimum minimum;
  CeresResult theirs;
  for ([[maybe_unused]] auto _ : run) {
    for (int i = 0; i < repetitions; ++i) {
      ours_s.push_back(seconds([&] { minimum = ours.solve(); }));
      ceres_side.restart();
      ceres_s.push_back(seconds([&] { theirs = ceres_side.solve(solver); }));
    }
  }
  run.counters["ours_ms"] = 1e3 * median(ours_s);
  run.counters["ceres_ms"] = 1e3 * median(ceres_s);
  run.counters["ratio"] = median(ceres_s) / median(ours_s);
  run.counters["our_iterations"] = minimum.iterations;
  run.counters["ceres_iterations"] = theirs.iterations;
  run.counters["cost"] = minimum.cost;
  run.counters["cost_difference"] = std::abs(minimum.cost - theirs.cost) / minimum.cost;
  if (!minimum.converged || !theirs.converged || !same_cost(minimum.cost, theirs.cost))
    run.SkipWithError("the two did not end at the same cost");
}

const Ours& climb() {
  static const Ours ours(made_climb(2000));
  return ours;
}

const Ours& grid() {
  static const Ours ours(made_grid(60000));
  return ours;
}

void Climb(benchmark::State& run, Derivatives derivatives, ceres::LinearSolverType solver) {
  solve_beside_ceres(run, climb(), derivatives, solver, 9);
}
BENCHMARK_CAPTURE(Climb, automatic_dense_schur, Derivatives::kAutomatic, ceres::DENSE_SCHUR)
    ->Iterations(1);
BENCHMARK_CAPTURE(Climb, automatic_sparse_schur, Derivatives::kAutomatic, ceres::SPARSE_SCHUR)
    ->Iterations(1);
BENCHMARK_CAPTURE(Climb, automatic_sparse_normal, Derivatives::kAutomatic,
                  ceres::SPARSE_NORMAL_CHOLESKY)
    ->Iterations(1);
BENCHMARK_CAPTURE(Climb, analytic_dense_schur, Derivatives::kAnalytic, ceres::DENSE_SCHUR)
    ->Iterations(1);
BENCHMARK_CAPTURE(Climb, analytic_sparse_schur, Derivatives::kAnalytic, ceres::SPARSE_SCHUR)
    ->Iterations(1);

void Grid(benchmark::State& run, Derivatives derivatives, ceres::LinearSolverType solver) {
  solve_beside_ceres(run, grid(), derivatives, solver, 3);
}
BENCHMARK_CAPTURE(Grid, automatic_sparse_schur, Derivatives::kAutomatic, ceres::SPARSE_SCHUR)
    ->Iterations(1);
BENCHMARK_CAPTURE(Grid, automatic_dense_schur, Derivatives::kAutomatic, ceres::DENSE_SCHUR)
    ->Iterations(1);
BENCHMARK_CAPTURE(Grid, analytic_sparse_schur, Derivatives::kAnalytic, ceres::SPARSE_SCHUR)
    ->Iterations(1);
BENCHMARK_CAPTURE(Grid, analytic_dense_schur, Derivatives::kAnalytic, ceres::DENSE_SCHUR)
    ->Iterations(1);

std::vector<Eigen::Matrix3d> covariances_of(const Ours& ours, const orient::State& state) {
  const auto terms = linearised_terms(ours.network, state, ours.settled, ours.block.terms);
  const auto covariance =
      orient::NetworkCovariance::of(ours.network, normal_equations(ours.network, state, 0, terms));
  return covariance->point_covariances();
}

// Largest difference of an entry, in the sigmas of its row and column.
double largest_difference(const std::vector<Eigen::Matrix3d>& ours, const CeresAdjustment& theirs) {
  double largest = 0;
  for (std::size_t p = 0; p < ours.size(); ++p) {
    const auto c = theirs.point_covariance(static_cast<int>(p));
    const Eigen::Vector3d sigma = ours[p].diagonal().cwiseSqrt();
    const Eigen::Matrix3d apart = ours[p] - Eigen::Map<const Eigen::Matrix3d>(c.data());
    largest =
        std::max(largest, apart.cwiseQuotient(sigma * sigma.transpose()).cwiseAbs().maxCoeff());
  }
  return largest;
}

void CovarianceOfAllPoints(benchmark::State& run, ceres::CovarianceAlgorithmType algorithm) {
  const Ours ours(made_climb(static_cast<int>(run.range(0))));
  CeresAdjustment ceres_side(ours.block, Derivatives::kAnalytic);
  std::vector<double> ours_s, ceres_s;
  std::vector<Eigen::Matrix3d> covariances;
  bool computed = true;
  for ([[maybe_unused]] auto _ : run) {
    for (int i = 0; i < 3; ++i) {
      ours_s.push_back(seconds([&] { covariances = covariances_of(ours, ours.solve().state); }));
      ceres_side.restart();
      ceres_s.push_back(seconds([&] {
        ceres_side.solve(ceres::DENSE_SCHUR);
        computed = ceres_side.covariance_of_points(algorithm) && computed;
      }));
    }
  }
  run.counters["ours_ms"] = 1e3 * median(ours_s);
  run.counters["ceres_ms"] = 1e3 * median(ceres_s);
  run.counters["ratio"] = median(ceres_s) / median(ours_s);
  if (!computed) {
    run.SkipWithError("Ceres found no covariance");
    return;
  }
  run.counters["largest_difference"] = largest_difference(covariances, ceres_side);
}
BENCHMARK_CAPTURE(CovarianceOfAllPoints, sparse_qr, ceres::SPARSE_QR)
    ->Arg(500)
    ->Arg(2000)
    ->Iterations(1);
BENCHMARK_CAPTURE(CovarianceOfAllPoints, dense_svd, ceres::DENSE_SVD)->Arg(100)->Iterations(1);

// Its time per iteration and point should be the same for all of them.
void OneIteration(benchmark::State& run) {
  const auto points = static_cast<int>(run.range(0));
  const MadeBlock block = made_climb(points);
  const orient::Network network = network_of(block);
  std::vector<double> per_iteration_s;
  for ([[maybe_unused]] auto _ : run) {
    for (int i = 0; i < 9; ++i) {
      orient::Minimum minimum;
      const double s = seconds([&] { minimum = minimum_of(block, network, block.start); });
      per_iteration_s.push_back(s / minimum.iterations);
    }
  }
  run.counters["us_per_iteration"] = 1e6 * median(per_iteration_s);
  run.counters["ns_per_iteration_and_point"] = 1e9 * median(per_iteration_s) / points;
}
BENCHMARK(OneIteration)->Arg(500)->Arg(1000)->Arg(2000)->Arg(4000)->Arg(8000)->Iterations(1);

}  // namespace
}  // namespace plumbline::bench

BENCHMARK_MAIN();
