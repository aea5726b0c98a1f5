// SPDX-License-Identifier: MIT
#include "edge/orient/reliability/image_correlation.h"

#include <gtest/gtest.h>

#include <map>
#include <numeric>
#include <random>
#include <tuple>

#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::orient {
namespace {

using testing::FlightPlan;
using testing::MadeFlight;
using testing::make_flight;

// Sigmas are 0.5 px as a first guess of ties; residuals at the truth are the errors put in.
double effect_of(double own_px, double shared_px, std::uint64_t seed) {
  FlightPlan plan;
  plan.targets = 400;
  plan.group = ImageGroup::kTies;
  plan.image_sigma_px = own_px;
  MadeFlight flight = make_flight(plan, seed);
  std::mt19937_64 random(seed + 1000);
  std::normal_distribution<double> normal(0, 1);
  std::map<std::tuple<int, int, int>, Eigen::Vector2d> shared;
  for (Observation& o : flight.problem.observations) {
    const std::tuple cell(o.photo, static_cast<int>(o.pixel.x() / 500),
                          static_cast<int>(o.pixel.y() / 375));
    if (!shared.contains(cell)) {
      const double u = normal(random), v = normal(random);
      shared[cell] = shared_px * Eigen::Vector2d(u, v);
    }
    o.pixel += shared[cell];
  }
  std::vector<int> photos(flight.poses.size());
  std::iota(photos.begin(), photos.end(), 0);
  const Network network = make_network(flight.problem, photos);
  return image_correlation(network, {flight.interior, flight.poses, flight.points}).design_effect;
}

TEST(ImageCorrelation, FindsNoneInIndependentErrors) {
  int found = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) found += effect_of(0.3, 0, seed) > 1 ? 1 : 0;
  EXPECT_LE(found, 3);
}

// Kish's effect of a mean of m per cell with intraclass correlation 1/2, cells weighted by m.
TEST(ImageCorrelation, FindsTheEffectOfAnErrorThatNeighboursShare) {
  double sum = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed) sum += effect_of(0.3, 0.3, seed) / 10;
  FlightPlan plan;
  plan.targets = 400;
  std::map<std::tuple<int, int, int>, double> counts;
  for (const Observation& o : make_flight(plan, 1).problem.observations) {
    ++counts[{o.photo, static_cast<int>(o.pixel.x() / 500), static_cast<int>(o.pixel.y() / 375)}];
  }
  double squares = 0, total = 0;
  for (const auto& [cell, n] : counts) {
    squares += n * n;
    total += n;
  }
  const double expected = 1 + (squares / total - 1) * 0.5;
  EXPECT_NEAR(sum, expected, 0.1 * expected);
}

}  // namespace
}  // namespace plumbline::orient
