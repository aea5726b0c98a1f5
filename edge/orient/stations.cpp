// SPDX-License-Identifier: MIT
#include "edge/orient/stations.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plumbline::orient {
namespace {

constexpr double kStationChiSquare3 = 16.27;  // 0.1 %
constexpr double kLeastRedundancy = 0.02;
constexpr double kStationCauchySigmas = 3;

}  // namespace

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
    const Eigen::Vector3d miss = pose.centre_m +
                                 pose.ground_from_photo * network.problem->lever_arm.in_photo_m -
                                 station->antenna_in_enu_m;
    Eigen::Matrix3d spread = station->covariance_m2 + 1e-8 * Eigen::Matrix3d::Identity();
    spread.diagonal() += common.cwiseAbs2();
    const double squared = miss.dot(spread.ldlt().solve(miss));
    weights[at(slot)] = 1 / (1 + squared / (kStationCauchySigmas * kStationCauchySigmas));
  }
  return weights;
}

int suspicious_station(const Network& network, const State& /*state*/, const TermOptions& options,
                       const std::vector<Term>& terms, const NetworkCovariance& covariance) {
  const std::vector<int> slots = station_slots(network, options);
  const auto term =
      std::find_if(terms.begin(), terms.end(), [](const Term& t) { return t.group == "gnss"; });
  if (term == terms.end() || slots.size() < 3) return -1;
  // A gross error of one station among correlated ones: with P the stations' information, v their
  // residuals and Q the residuals' covariance, it shows in P v, whose covariance is P Q P (Baarda
  // 1968). An error common to all of them so hides nothing of it.
  const Eigen::MatrixXd& p = term->information;
  const Eigen::MatrixXd adjusted = term->jacobian *
                                   covariance.common()(term->columns, term->columns) *
                                   term->jacobian.transpose();
  const Eigen::MatrixXd spread = p - p * adjusted * p;
  const Eigen::VectorXd weighted = p * term->residual;
  int worst = -1;
  double most = kStationChiSquare3;
  for (std::size_t k = 0; k < slots.size(); ++k) {
    const auto row = static_cast<Eigen::Index>(3 * k);
    const Eigen::Matrix3d own = p.block<3, 3>(row, row);
    const Eigen::Matrix3d of_weighted = spread.block<3, 3>(row, row);
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::Matrix3d> modes(of_weighted, own);
    const Eigen::Vector3d v = modes.eigenvectors().transpose() * weighted.segment<3>(row);
    double statistic = 0;
    for (int i = 0; i < 3; ++i) {
      if (modes.eigenvalues()[i] > kLeastRedundancy)
        statistic += v[i] * v[i] / modes.eigenvalues()[i];
    }
    if (statistic <= most) continue;
    most = statistic;
    worst = slots[k];
  }
  return worst;
}

}  // namespace plumbline::orient
