// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

namespace plumbline::timing {

// Position, velocity and acceleration, three axes each; metres and seconds.
struct MotionState {
  using Vector = Eigen::Matrix<double, 9, 1>;
  using Matrix = Eigen::Matrix<double, 9, 9>;

  Vector mean = Vector::Zero();
  Matrix covariance = Matrix::Zero();

  Eigen::Vector3d position_m() const { return mean.head<3>(); }
  Eigen::Vector3d velocity_m_s() const { return mean.segment<3>(3); }
};

// How an aircraft moves: its acceleration is a Gauss-Markov process of that standard deviation,
// forgotten after that time (Singer 1970, "Estimating optimal tracking filter performance for
// manned maneuvering targets").
struct MotionOptions {
  double acceleration_sigma_m_s2 = 1.2;
  double correlation_s = 1.0;
  double velocity_sigma_m_s = 10;  // before anything is known
  double turn_acceleration_m_s2 = 4;
  double turn_velocity_m_s = 0.4;
};

// The Kalman filter of that motion. Pure functions of state and time.
class MotionFilter {
 public:
  explicit MotionFilter(const MotionOptions& options = {}) : options_(options) {}

  MotionState begun_at(const Eigen::Vector3d& position_m, const Eigen::Matrix3d& noise_m2) const;

  // `seconds` >= 0 later, nothing having been seen.
  MotionState after(const MotionState& state, double seconds) const;

  // The same where a pilot may have moved the sticks just then: velocity and acceleration are less
  // certain by these standard deviations.
  MotionState after_a_turn(MotionState state, double seconds) const;

  // With a position seen at the instant of `state`.
  static MotionState with(const MotionState& state, const Eigen::Vector3d& position_m,
                          const Eigen::Matrix3d& noise_m2);

  // What is known of `state` once it is known how it went on (Rauch, Tung and Striebel 1965):
  // `foreseen` is after(state), and whatever was added to it, and `known` the same instant as known
  // from all that was seen.
  MotionState smoothed(const MotionState& state, double seconds, const MotionState& foreseen,
                       const MotionState& known) const;

 private:
  MotionState::Matrix transition(double seconds) const;
  MotionState::Matrix process_noise(double seconds) const;
  Eigen::Vector3d response(double seconds) const;

  MotionOptions options_;
};

}  // namespace plumbline::timing
