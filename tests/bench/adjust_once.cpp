// SPDX-License-Identifier: MIT
// One solve of one side of adjust_bench, for counting instructions:
//
//   valgrind --tool=callgrind --callgrind-out-file=/dev/null --toggle-collect='*measured*'
//       build/bench/tests/bench/adjust_once ours|automatic|analytic climb|grid [points]
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/bench/ceres_adjustment.h"
#include "tests/bench/made_block.h"

namespace plumbline::bench {
namespace {

[[gnu::noinline]] void measured_ours(const MadeBlock& block, const orient::Network& network) {
  const orient::Minimum minimum = minimum_of(block, network, block.start);
  std::printf("cost %.12g, %d iterations\n", minimum.cost, minimum.iterations);
}

[[gnu::noinline]] void measured_ceres(CeresAdjustment& adjustment, ceres::LinearSolverType solver) {
  const CeresResult result = adjustment.solve(solver);
  std::printf("cost %.12g, %d iterations\n", result.cost, result.iterations);
}

int run(const std::string& side, const std::string& which, int points) {
  const bool is_climb = which == "climb";
  const MadeBlock block = is_climb ? made_climb(points) : made_grid(points);
  if (side == "ours") {
    measured_ours(block, network_of(block));
    return EXIT_SUCCESS;
  }
  CeresAdjustment adjustment(
      block, side == "automatic" ? Derivatives::kAutomatic : Derivatives::kAnalytic);
  measured_ceres(adjustment, is_climb ? ceres::DENSE_SCHUR : ceres::SPARSE_SCHUR);
  return EXIT_SUCCESS;
}

}  // namespace
}  // namespace plumbline::bench

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fputs("usage: adjust_once ours|automatic|analytic climb|grid [points]\n", stderr);
    return EXIT_FAILURE;
  }
  return plumbline::bench::run(argv[1], argv[2], argc > 3 ? std::atoi(argv[3]) : 2000);
}
