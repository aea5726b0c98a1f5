// SPDX-License-Identifier: MIT
#include "sim/gnss_error.h"

#include <cmath>

namespace plumbline::sim {
namespace {

Eigen::Vector3d draw(const SigmaPair& sigma, Random& random) {
  Eigen::Vector3d unit;
  for (int axis = 0; axis < 3; ++axis) unit[axis] = random.normal();
  return sigma.per_axis().cwiseProduct(unit);
}

}  // namespace

std::vector<Eigen::Vector3d> gnss_errors(const GnssErrorSigmas& sigmas,
                                         const std::vector<double>& times_s, Random& random) {
  const Eigen::Vector3d offset_m = draw(sigmas.offset, random);
  Eigen::Vector3d correlated_m = draw(sigmas.correlated, random);
  std::vector<Eigen::Vector3d> errors_m;
  for (std::size_t k = 0; k < times_s.size(); ++k) {
    if (k > 0) {
      // First-order Gauss-Markov, stationary from the first photo on.
      const double kept = std::exp(-(times_s[k] - times_s[k - 1]) / sigmas.correlation_s);
      correlated_m =
          kept * correlated_m + std::sqrt(1 - kept * kept) * draw(sigmas.correlated, random);
    }
    errors_m.push_back(offset_m + correlated_m + draw(sigmas.white, random));
  }
  return errors_m;
}

}  // namespace plumbline::sim
