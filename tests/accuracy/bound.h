// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "tests/edge/orient/made/made_flight.h"

namespace plumbline::accuracy {

// The least covariance that any unbiased estimator can have for a flight (Cramer 1946, Rao 1945;
// with priors: Van Trees 1968, eq. 2.4): the inverse of the Fisher information at the truth of all
// observations that are not gross, and of what is known before. Derivatives by central
// differences of the camera model, algebra of its own: nothing here is the adjustment's.
struct Bound {
  Eigen::MatrixXd targets;    // 3n x 3n, m2; of the first `targets` points
  Eigen::MatrixXd common;     // interior (10), then photos (centre 3 in m, rotation 3 in rad)
  std::vector<bool> defined;  // by target: two rays or more that are not gross
};

// `tilt_sigma_rad`: what is known of each photo's tilt about the vertical. Empty where the
// information is singular: nothing fixes the datum, say.
std::optional<Bound> bound_of(const orient::testing::MadeFlight& flight, double tilt_sigma_rad);

}  // namespace plumbline::accuracy
