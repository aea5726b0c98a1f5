// SPDX-License-Identifier: MIT
#include "edge/orient/network/stations.h"

#include <Eigen/Cholesky>
#include <cmath>

namespace plumbline::orient {
namespace {

constexpr double kStationCauchySigmas = 3;

}  // namespace

Eigen::Vector3d velocity_in_enu_m_s(const Network& network, int slot) {
  return network.photo(slot).velocity_in_enu_m_s.value_or(Eigen::Vector3d::Zero());
}

Eigen::Vector3d shift_by_delay_sigma_m(const Network& network, int slot) {
  return network.problem->delay.sigma_s * velocity_in_enu_m_s(network, slot);
}

double station_weight_at(double sigmas) {
  return 1 / (1 + std::pow(sigmas / kStationCauchySigmas, 2));
}

std::vector<double> robust_station_weights(const Network& network, const State& state) {
  std::vector<double> weights(at(network.slots()), 1.0);
  const GnssErrorModel& model = network.problem->gnss;
  const Eigen::Vector3d common(
      std::hypot(model.offset_sigma_horizontal_m, model.correlated_sigma_horizontal_m),
      std::hypot(model.offset_sigma_horizontal_m, model.correlated_sigma_horizontal_m),
      std::hypot(model.offset_sigma_vertical_m, model.correlated_sigma_vertical_m));
  for (int slot = 0; slot < network.slots(); ++slot) {
    const auto& station = network.photo(slot).station;
    if (!station) continue;
    const geometry::Pose& pose = state.poses[at(slot)];
    const Eigen::Vector3d miss =
        pose.centre_m + pose.ground_from_photo * network.problem->lever_arm.in_photo_m -
        state.delay_s * velocity_in_enu_m_s(network, slot) - station->antenna_in_enu_m;
    const Eigen::Vector3d delayed_m = shift_by_delay_sigma_m(network, slot);
    Eigen::Matrix3d spread = station->covariance_m2 + delayed_m * delayed_m.transpose() +
                             1e-8 * Eigen::Matrix3d::Identity();
    spread.diagonal() += common.cwiseAbs2();
    const double squared = miss.dot(spread.ldlt().solve(miss));
    weights[at(slot)] = station_weight_at(std::sqrt(squared));
  }
  return weights;
}

}  // namespace plumbline::orient
