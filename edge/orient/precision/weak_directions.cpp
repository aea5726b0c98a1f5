// SPDX-License-Identifier: MIT
#include "edge/orient/precision/weak_directions.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

namespace plumbline::orient {
namespace {

// What makes angles of the columns of the reduced system: what they move in the image, over the
// focal length.
Eigen::VectorXd angle_by_column(const Network& network, const State& state) {
  const double f = state.interior[geometry::kFocalLength];
  const double half =
      0.5 * std::hypot(network.problem->camera.width_px, network.problem->camera.height_px) / f;
  const double height = std::max(std::abs(flying_height(network, state)), 1e-3);
  Eigen::VectorXd scale = Eigen::VectorXd::Zero(network.layout.columns());
  scale[geometry::kFocalLength] = half / f;
  scale[geometry::kPrincipalU] = scale[geometry::kPrincipalV] = 1 / f;
  scale[geometry::kAffinity] = scale[geometry::kSkew] = half;
  scale[geometry::kRadial1] = std::pow(half, 3);
  scale[geometry::kRadial2] = std::pow(half, 5);
  scale[geometry::kRadial3] = std::pow(half, 7);
  scale[geometry::kTangential1] = scale[geometry::kTangential2] = half * half;
  scale.head<kShared>().array() *= network.shared_mask.array();
  for (int slot = 0; slot < network.slots(); ++slot) {
    scale.segment<3>(network.layout.photo(slot)).setConstant(1 / height);
    scale.segment<3>(network.layout.photo(slot) + 3).setOnes();
  }
  return scale;
}

}  // namespace

std::vector<WeakDirection> weak_directions(const Network& network, const State& state,
                                           const Eigen::MatrixXd& common) {
  const Eigen::VectorXd scale = angle_by_column(network, state);
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(scale.asDiagonal() * common *
                                                             scale.asDiagonal());
  std::vector<WeakDirection> out;
  for (auto k = modes.eigenvalues().size(); k-- > 0;) {
    out.push_back({scale.cwiseProduct(modes.eigenvectors().col(k)),
                   std::sqrt(std::max(modes.eigenvalues()[k], 0.0))});
  }
  return out;
}

}  // namespace plumbline::orient
