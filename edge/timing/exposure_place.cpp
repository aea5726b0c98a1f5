// SPDX-License-Identifier: MIT
#include "edge/timing/exposure_place.h"

namespace plumbline::timing {

std::optional<PredictedAntenna> place_of_exposure(const AntennaPredictor& antenna,
                                                  const ExposureTiming& exposure, double row,
                                                  const GnssClock& clock) {
  auto place = antenna.at(exposure.middle_of_row(row), clock);
  if (!place) return std::nullopt;
  const double sigma_s = std::chrono::duration<double>(exposure.sigma).count();
  const Eigen::Vector3d moved_m = place->velocity_enu_m_s * sigma_s;
  place->covariance_enu_m2 += moved_m * moved_m.transpose();
  return place;
}

}  // namespace plumbline::timing
