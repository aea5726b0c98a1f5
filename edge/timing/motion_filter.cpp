// SPDX-License-Identifier: MIT
#include "edge/timing/motion_filter.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace plumbline::timing {
namespace {

using Vector = MotionState::Vector;
using Matrix = MotionState::Matrix;

// The same small matrix for each of the three axes.
Matrix for_each_axis(const Eigen::Matrix3d& one) {
  Matrix all = Matrix::Zero();
  for (Eigen::Index i = 0; i < 3; ++i) {
    for (Eigen::Index j = 0; j < 3; ++j) {
      all.block<3, 3>(3 * i, 3 * j) = one(i, j) * Eigen::Matrix3d::Identity();
    }
  }
  return all;
}

Matrix symmetric(const Matrix& m) { return 0.5 * (m + m.transpose()); }

}  // namespace

MotionState MotionFilter::begun_at(const Eigen::Vector3d& position_m,
                                   const Eigen::Matrix3d& noise_m2) const {
  MotionState state;
  state.mean.head<3>() = position_m;
  state.covariance.topLeftCorner<3, 3>() = noise_m2;
  const double v = options_.velocity_sigma_m_s;
  const double a = options_.acceleration_sigma_m_s2;
  state.covariance.diagonal().segment<3>(3).setConstant(v * v);
  state.covariance.diagonal().tail<3>().setConstant(a * a);
  return state;
}

MotionState MotionFilter::after(const MotionState& state, double seconds) const {
  const Matrix f = transition(seconds);
  return {f * state.mean, symmetric(f * state.covariance * f.transpose() + process_noise(seconds))};
}

MotionState MotionFilter::after_a_turn(MotionState state, double seconds) const {
  const double v = options_.turn_velocity_m_s;
  const double a = options_.turn_acceleration_m_s2;
  state.covariance.diagonal().segment<3>(3).array() += v * v;
  state.covariance.diagonal().tail<3>().array() += a * a;
  return after(state, seconds);
}

MotionState MotionFilter::with(const MotionState& state, const Eigen::Vector3d& position_m,
                               const Eigen::Matrix3d& noise_m2) {
  const Eigen::Matrix<double, 9, 3> to_seen = state.covariance.leftCols<3>();
  const Eigen::Matrix3d seen = to_seen.topRows<3>() + noise_m2;
  const Eigen::Matrix<double, 9, 3> gain = seen.ldlt().solve(to_seen.transpose()).transpose();
  // Joseph's form: stays positive whatever is rounded.
  Matrix rest = Matrix::Identity();
  rest.leftCols<3>() -= gain;
  return {
      state.mean + gain * (position_m - state.position_m()),
      symmetric(rest * state.covariance * rest.transpose() + gain * noise_m2 * gain.transpose())};
}

MotionState MotionFilter::smoothed(const MotionState& state, double seconds,
                                   const MotionState& foreseen, const MotionState& known) const {
  const Matrix ahead = transition(seconds) * state.covariance;
  const Matrix gain = foreseen.covariance.ldlt().solve(ahead).transpose();
  return {state.mean + gain * (known.mean - foreseen.mean),
          symmetric(state.covariance +
                    gain * (known.covariance - foreseen.covariance) * gain.transpose())};
}

// What a unit acceleration has made of position, velocity and itself after so long.
Eigen::Vector3d MotionFilter::response(double seconds) const {
  const double tau = options_.correlation_s;
  const double lost = -std::expm1(-seconds / tau);
  return {tau * (seconds - tau * lost), tau * lost, 1 - lost};
}

Matrix MotionFilter::transition(double seconds) const {
  Eigen::Matrix3d one = Eigen::Matrix3d::Identity();
  one(0, 1) = seconds;
  one.col(2) = response(seconds);
  return for_each_axis(one);
}

// The integral of response * response^T by Gauss and Legendre's rule of five points: positive,
// where the closed form cancels at short times.
Matrix MotionFilter::process_noise(double seconds) const {
  constexpr double kNodes[] = {-0.9061798459386640, -0.5384693101056831, 0, 0.5384693101056831,
                               0.9061798459386640};
  constexpr double kWeights[] = {0.2369268850561891, 0.4786286704993665, 0.5688888888888889,
                                 0.4786286704993665, 0.2369268850561891};
  const double sigma = options_.acceleration_sigma_m_s2;
  const double density = 2 * sigma * sigma / options_.correlation_s;
  Eigen::Matrix3d one = Eigen::Matrix3d::Zero();
  for (int k = 0; k < 5; ++k) {
    const Eigen::Vector3d g = response(0.5 * seconds * (1 + kNodes[k]));
    one += density * 0.5 * seconds * kWeights[k] * g * g.transpose();
  }
  return for_each_axis(one);
}

}  // namespace plumbline::timing
