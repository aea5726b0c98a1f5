// SPDX-License-Identifier: MIT
#include "edge/orient/derived.h"

#include <gtest/gtest.h>

#include <Eigen/Core>
#include <cmath>
#include <functional>
#include <random>

#include "edge/base/index.h"

namespace plumbline::orient {
namespace {

// A covariance that couples all points, as an adjustment's does.
class Coupled final : public PointCovariances {
 public:
  explicit Coupled(int points) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal(0, 0.01);
    root.resize(3 * points, 3 * points);
    for (double& entry : root.reshaped()) entry = normal(random);
  }
  Eigen::MatrixXd joint(const std::vector<int>& points) const override {
    std::vector<int> rows;
    for (const int p : points) rows.insert(rows.end(), {3 * p, 3 * p + 1, 3 * p + 2});
    const Eigen::MatrixXd of_them = root(rows, Eigen::all);
    return of_them * of_them.transpose();
  }
  Eigen::MatrixXd with_photo(int /*photo*/, const std::vector<int>& points) const override {
    return Eigen::MatrixXd::Zero(6, 3 * static_cast<Eigen::Index>(points.size()));
  }
  Eigen::MatrixXd root;
};

// An L, not convex: 102 m2 by the shoelace formula.
const std::vector<Eigen::Vector3d> kCorners = {{0, 0, 2}, {12, 0, 3}, {12, 6, 2.5},
                                               {5, 5, 4}, {6, 12, 1}, {0, 12, 2}};
const std::vector<int> kRound = {0, 1, 2, 3, 4, 5};

Solution solution_with(const std::vector<Eigen::Vector3d>& places) {
  Solution solution;
  for (const auto& place : places) {
    MeasuredPoint point;
    point.measured = true;
    point.in_enu_m = place;
    solution.points.push_back(point);
  }
  solution.covariances = std::make_shared<Coupled>(static_cast<int>(places.size()));
  return solution;
}

using Figure = std::function<Result<Derived>(const Solution&)>;
const std::vector<Figure> kFigures = {
    [](const Solution& s) { return distance(s, 1, 4); },
    [](const Solution& s) { return area(s, kRound); },
    [](const Solution& s) { return volume(s, kRound, 1.25); },
};

TEST(Derived, AgreesWithFiguresWorkedByHand) {
  const Solution solution = solution_with(kCorners);
  EXPECT_NEAR(distance(solution, 0, 5)->value, 12, 1e-12);
  EXPECT_NEAR(area(solution, kRound)->value, 102, 1e-12);
  EXPECT_NEAR(area(solution, {5, 4, 3, 2, 1, 0})->value, 102, 1e-12);
  EXPECT_NEAR(volume(solution, {0, 1, 5}, 1)->value, 72 * (7.0 / 3 - 1), 1e-12);
}

// A flat roof at 3 m over a floor at 1 m, whichever way the triangles are cut.
TEST(Derived, GivesTheVolumeOfAPrismOverAPolygonThatIsNotConvex) {
  auto flat = kCorners;
  for (auto& corner : flat) corner.z() = 3;
  EXPECT_NEAR(volume(solution_with(flat), kRound, 1)->value, 204, 1e-10);
  EXPECT_NEAR(volume(solution_with(flat), {5, 4, 3, 2, 1, 0}, 4)->value, -102, 1e-10);
}

TEST(Derived, HasTrueDerivatives) {
  constexpr double kStep = 1e-6;
  for (const Figure& figure : kFigures) {
    const auto here = figure(solution_with(kCorners));
    const std::vector<int> points = here->jacobian.size() == 6 ? std::vector<int>{1, 4} : kRound;
    for (Eigen::Index i = 0; i < here->jacobian.size(); ++i) {
      auto up = kCorners, down = kCorners;
      up[at(points[static_cast<std::size_t>(i / 3)])][i % 3] += kStep;
      down[at(points[static_cast<std::size_t>(i / 3)])][i % 3] -= kStep;
      const double slope =
          (figure(solution_with(up))->value - figure(solution_with(down))->value) / (2 * kStep);
      EXPECT_NEAR(here->jacobian[i], slope, 1e-6);
    }
  }
}

// The scatter of 4000 draws is known to 1.1 % (standard deviation of a sigma).
TEST(Derived, HasTheSigmaOfManyDraws) {
  const Coupled coupled(6);
  for (const Figure& figure : kFigures) {
    std::mt19937_64 random(6);
    std::normal_distribution<double> normal;
    const auto truth = figure(solution_with(kCorners));
    double squares = 0;
    const int draws = 4000;
    for (int draw = 0; draw < draws; ++draw) {
      Eigen::VectorXd noise(18);
      for (double& entry : noise) entry = normal(random);
      noise = coupled.root * noise;
      auto moved = kCorners;
      for (std::size_t p = 0; p < moved.size(); ++p)
        moved[p] += noise.segment<3>(static_cast<Eigen::Index>(3 * p));
      squares += std::pow(figure(solution_with(moved))->value - truth->value, 2);
    }
    EXPECT_NEAR(std::sqrt(squares / draws) / truth->sigma, 1, 0.05);
  }
}

TEST(Derived, RefusesWhatIsNoPolygonOrWasNotMeasured) {
  Solution solution = solution_with(kCorners);
  EXPECT_FALSE(area(solution, {0, 1}));
  EXPECT_FALSE(area(solution, {0, 2, 1, 5}));
  EXPECT_FALSE(distance(solution, 2, 2));
  EXPECT_FALSE(distance(solution, 2, 99));
  solution.points[3].measured = false;
  EXPECT_FALSE(volume(solution, kRound, 0));
}

}  // namespace
}  // namespace plumbline::orient
