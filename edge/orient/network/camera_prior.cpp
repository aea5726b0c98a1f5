// SPDX-License-Identifier: MIT
#include "edge/orient/network/camera_prior.h"

#include <Eigen/LU>
#include <cmath>
#include <vector>

namespace plumbline::orient {
namespace {

using geometry::Camera;
using geometry::InteriorMatrix;
using geometry::InteriorVector;
using geometry::kInteriorCount;

InteriorVector widest(const Camera& camera) {
  const double f = camera.interior[geometry::kFocalLength];
  const double centre = 0.05 * camera.width_px;
  InteriorVector sigma;
  sigma << 0.2 * f, centre, centre, 0.01, 0.01, 0.5, 0.5, 0.5, 0.01, 0.01;
  return sigma;
}

InteriorVector bridle(const Camera& camera) {
  const double f = camera.interior[geometry::kFocalLength];
  const double centre = 0.01 * camera.width_px;
  InteriorVector sigma;
  sigma << 0.05 * f, centre, centre, 1e-3, 1e-3, 0.1, 0.1, 0.1, 2e-3, 2e-3;
  return sigma;
}

// Inverts the covariance over the parameters it says something about; others keep `sigma`.
InteriorMatrix information_of_covariance(const InteriorMatrix& covariance,
                                         const InteriorVector& sigma) {
  std::vector<int> known;
  InteriorMatrix information = InteriorMatrix::Zero();
  for (int i = 0; i < kInteriorCount; ++i) {
    if (sigma[i] == 0) continue;
    if (std::isfinite(covariance(i, i))) {
      known.push_back(i);
    } else {
      information(i, i) = 1 / (sigma[i] * sigma[i]);
    }
  }
  const Eigen::MatrixXd inverse = covariance(known, known).inverse();
  information(known, known) = inverse;
  return information;
}

}  // namespace

InteriorVector prior_sigmas(const Camera& camera) {
  const InteriorVector limit = widest(camera);
  InteriorVector sigma = camera.sigma;
  for (int i = 0; i < kInteriorCount; ++i) {
    if (camera.covariance) sigma[i] = std::sqrt((*camera.covariance)(i, i));
    if (!std::isfinite(sigma[i])) sigma[i] = limit[i];
  }
  return sigma;
}

InteriorMatrix prior_information(const Camera& camera) {
  const InteriorVector sigma = prior_sigmas(camera);
  if (camera.covariance) return information_of_covariance(*camera.covariance, sigma);
  InteriorMatrix information = InteriorMatrix::Zero();
  for (int i = 0; i < kInteriorCount; ++i) {
    if (sigma[i] > 0) information(i, i) = 1 / (sigma[i] * sigma[i]);
  }
  return information;
}

InteriorMatrix bridle_information(const Camera& camera) {
  const InteriorVector sigma = prior_sigmas(camera);
  const InteriorVector spring = bridle(camera);
  InteriorMatrix information = InteriorMatrix::Zero();
  for (int i = 0; i < kInteriorCount; ++i) {
    if (sigma[i] > 0) information(i, i) = 1 / (spring[i] * spring[i]);
  }
  return information;
}

}  // namespace plumbline::orient
