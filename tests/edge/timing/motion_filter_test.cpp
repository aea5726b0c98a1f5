// SPDX-License-Identifier: MIT
#include "edge/timing/motion_filter.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <array>
#include <cmath>

#include "sim/random.h"

namespace plumbline::timing {
namespace {

// Singer's model typed anew, one axis: integrated in small steps instead of in closed form.
struct Step {
  Eigen::Matrix3d transition = Eigen::Matrix3d::Identity();
  Eigen::Matrix3d noise = Eigen::Matrix3d::Zero();
};

Step step_of(double seconds, const MotionOptions& options) {
  constexpr int kSteps = 20000;
  const double dt = seconds / kSteps;
  const double keep = std::exp(-dt / options.correlation_s);
  const double sigma = options.acceleration_sigma_m_s2;
  Eigen::Matrix3d small;
  small << 1, dt, dt * dt / 2, 0, 1, dt, 0, 0, keep;
  Step step;
  for (int k = 0; k < kSteps; ++k) {
    step.transition = small * step.transition;
    step.noise = small * step.noise * small.transpose();
    step.noise(2, 2) += sigma * sigma * (1 - keep * keep);
  }
  return step;
}

// All states of one axis at once, by least squares: what is known before, each motion from one to
// the next, and each position seen is an observation with its weight.
class BatchOfOneAxis {
 public:
  explicit BatchOfOneAxis(int states)
      : normal_(Eigen::MatrixXd::Zero(3 * states, 3 * states)),
        right_(Eigen::VectorXd::Zero(3 * states)) {}

  void begun(double position_m, double noise_m2, const MotionOptions& options) {
    seen(0, position_m, noise_m2);
    normal_(1, 1) += 1 / std::pow(options.velocity_sigma_m_s, 2);
    normal_(2, 2) += 1 / std::pow(options.acceleration_sigma_m_s2, 2);
  }
  void moved(int from, const Step& step) {
    Eigen::MatrixXd design = Eigen::MatrixXd::Zero(3, normal_.cols());
    design.middleCols<3>(3 * from) = -step.transition;
    design.middleCols<3>(3 * from + 3).setIdentity();
    normal_ += design.transpose() * step.noise.inverse() * design;
  }
  void seen(int state, double position_m, double noise_m2) {
    normal_(3 * state, 3 * state) += 1 / noise_m2;
    right_(3 * state) += position_m / noise_m2;
  }
  Eigen::VectorXd solution() const { return normal_.fullPivLu().solve(right_); }
  Eigen::MatrixXd covariance() const { return normal_.fullPivLu().inverse(); }

 private:
  Eigen::MatrixXd normal_;
  Eigen::VectorXd right_;
};

constexpr double kNoise_m2 = 0.02 * 0.02;

TEST(MotionFilter, AgreesWithABatchOfAllEpochsForwardAndSmoothed) {
  const MotionOptions options;
  const MotionFilter filter(options);
  const std::array<double, 7> gaps_s = {0.2, 0.2, 0.4, 0.1, 0.2, 1.0, 0.3};
  sim::Random random(1, 52);
  BatchOfOneAxis batch(8);
  std::array<MotionState, 8> foreseen;
  std::array<MotionState, 8> states;
  const Eigen::Matrix3d noise_m2 = kNoise_m2 * Eigen::Matrix3d::Identity();
  batch.begun(0.01, kNoise_m2, options);
  states[0] = filter.begun_at({5, 6, 0.01}, noise_m2);
  double height_m = 0;
  for (int k = 1; k < 8; ++k) {
    const double gap_s = gaps_s[static_cast<std::size_t>(k) - 1];
    height_m += 2 * gap_s + 0.05 * random.normal();
    const auto now = static_cast<std::size_t>(k);
    foreseen[now] = filter.after(states[now - 1], gap_s);
    states[now] = MotionFilter::with(foreseen[now], {5, 6, height_m}, noise_m2);
    batch.moved(k - 1, step_of(gap_s, options));
    batch.seen(k, height_m, kNoise_m2);
  }
  const Eigen::VectorXd solution = batch.solution();
  const Eigen::MatrixXd covariance = batch.covariance();
  MotionState known = states[7];
  for (int k = 7; k >= 0; --k) {
    const auto now = static_cast<std::size_t>(k);
    if (k < 7) known = filter.smoothed(states[now], gaps_s[now], foreseen[now + 1], known);
    for (int part = 0; part < 3; ++part) {
      const int up = 3 * part + 2;
      EXPECT_NEAR(known.mean[up], solution[3 * k + part], 1e-4) << k << part;
      const double sigma = std::sqrt(covariance(3 * k + part, 3 * k + part));
      EXPECT_NEAR(std::sqrt(known.covariance(up, up)) / sigma, 1, 1e-3) << k << part;
    }
  }
}

TEST(MotionFilter, IsTheSameInOneStepOrInTwo) {
  const MotionFilter filter;
  const MotionState start = filter.begun_at({1, 2, 3}, kNoise_m2 * Eigen::Matrix3d::Identity());
  const MotionState once = filter.after(start, 0.7);
  const MotionState twice = filter.after(filter.after(start, 0.3), 0.4);
  EXPECT_TRUE(once.mean.isApprox(twice.mean, 1e-12));
  EXPECT_TRUE(once.covariance.isApprox(twice.covariance, 1e-6));
}

TEST(MotionFilter, StaysPositiveOverVeryShortSteps) {
  const MotionFilter filter;
  const Eigen::Matrix3d noise_m2 = 1e-6 * Eigen::Matrix3d::Identity();
  MotionState state = filter.begun_at({0, 0, 0}, noise_m2);
  for (int k = 0; k < 20000; ++k) {
    state = MotionFilter::with(filter.after(state, k % 2 == 0 ? 1e-9 : 1e-4), {0, 0, 0}, noise_m2);
  }
  EXPECT_EQ(state.covariance.llt().info(), Eigen::Success);
}

}  // namespace
}  // namespace plumbline::timing
