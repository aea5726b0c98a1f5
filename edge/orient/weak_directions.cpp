// SPDX-License-Identifier: MIT
#include "edge/orient/weak_directions.h"

#include <Eigen/Eigenvalues>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "edge/geometry/rotation.h"
#include "edge/orient/diagnosis.h"
#include "edge/orient/minimise.h"
#include "edge/orient/step.h"

namespace plumbline::orient {
namespace {

// Directions known better than this bend by less than 0.2 mm in a picture of a hundred metres.
constexpr double kLeastAngleRad = 0.002;
constexpr int kMostDirections = 6;
constexpr double kFarthestRad = 2.5;
constexpr int kIterations = 60;
constexpr double kTolerance = 1e-7;
constexpr double kPinSigma = 0.02;  // of the direction's own
constexpr double kShortest = 0.98;  // of the straight variance, where rounding is to blame

struct Node {
  double at_sigmas = 0;
  double weight = 0;
};
constexpr double kMiddleWeight = 8.0 / 15;
constexpr std::array<Node, 4> kNodes = {{{-2.8569700138728056, 0.011257411327720689},
                                         {-1.3556261799742659, 0.22207592200561266},
                                         {1.3556261799742659, 0.22207592200561266},
                                         {2.8569700138728056, 0.011257411327720689}}};

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

// How one place of the network lies from another, by column and by point.
Step displacement(const Network& network, const State& from, const State& to) {
  Step step{pin_displacement(network, from, to), {}};
  step.points.resize(to.points.size());
  for (std::size_t p = 0; p < to.points.size(); ++p) step.points[p] = to.points[p] - from.points[p];
  return step;
}

// A displacement and the square root of its weight.
struct Place {
  double weight = 0;
  Step from_estimate;
};

class Explorer {
 public:
  Explorer(const Network& network, const State& state, const State& datum, const TermOptions& terms,
           const NetworkCovariance& straight)
      : network_(network), state_(state), datum_(datum), terms_(terms), straight_(straight) {
    cost_ = cost_at(state);
  }

  // Along the pinned quantity gradient' dx, whose sigma is given. Empty where a place could not
  // be reached, or where the bar would become shorter: then the straight one stays.
  std::vector<Place> along(const Eigen::VectorXd& gradient, double sigma) const {
    const Step step = straight_step(gradient, sigma);
    std::vector<Place> places;
    double total = kMiddleWeight, moment = 0;
    for (const Node& node : kNodes) {
      if (std::abs(node.at_sigmas) * sigma > kFarthestRad) continue;
      TermOptions pinned = terms_;
      pinned.pin = Pin{gradient, state_, node.at_sigmas * sigma, kPinSigma * sigma};
      const State start = moved_by(network_, state_, scaled(step, node.at_sigmas));
      const Minimum found = minimise(network_, start, datum_, pinned, {0, kIterations, kTolerance});
      const double rise = cost_at(found.state) - cost_;
      Place place{0, displacement(network_, state_, found.state)};
      const double reached = gradient.dot(place.from_estimate.common) / sigma;
      if (!found.converged || !std::isfinite(rise)) return {};
      place.weight = node.weight * std::exp(-0.5 * (std::max(rise, 0.0) - reached * reached));
      total += place.weight;
      moment += place.weight * reached * reached;
      places.push_back(std::move(place));
    }
    if (moment < kShortest * total) return {};
    for (Place& place : places) place.weight /= total;
    return places;
  }

  // One sigma along the direction, as the straight covariance has it.
  Step straight_step(const Eigen::VectorXd& gradient, double sigma) const {
    Step step{straight_.common() * gradient / sigma, {}};
    step.points.assign(at(network_.points()), Eigen::Vector3d::Zero());
    for (int p = 0; p < network_.points(); ++p) {
      const PointFactor& factor = straight_.point(p);
      if (factor.measured) step.points[at(p)] = factor.by_common * step.common(factor.columns);
    }
    return step;
  }

 private:
  double cost_at(const State& state) const {
    return linearise_rays(network_, state, 0).cost +
           cost_of(linearised_terms(network_, state, datum_, terms_));
  }
  static Step scaled(Step step, double by) {
    step.common *= by;
    for (Eigen::Vector3d& point : step.points) point *= by;
    return step;
  }

  const Network& network_;
  const State& state_;
  const State& datum_;
  const TermOptions& terms_;
  const NetworkCovariance& straight_;
  double cost_ = 0;
};

}  // namespace

NetworkCovariance bent_covariance(const Network& network, const State& state, const State& datum,
                                  const TermOptions& terms, const NetworkCovariance& straight) {
  NetworkCovariance bent = straight;
  const Eigen::VectorXd scale = angle_by_column(network, state);
  const Eigen::MatrixXd in_angles = scale.asDiagonal() * straight.common() * scale.asDiagonal();
  if (in_angles.trace() < kLeastAngleRad * kLeastAngleRad) return bent;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> modes(in_angles);
  const Explorer explorer(network, state, datum, terms, straight);
  const auto last = modes.eigenvalues().size() - 1;
  for (int k = 0; k < kMostDirections && k <= last; ++k) {
    const double sigma = std::sqrt(std::max(modes.eigenvalues()[last - k], 0.0));
    if (sigma < kLeastAngleRad) break;
    const Eigen::VectorXd gradient = scale.cwiseProduct(modes.eigenvectors().col(last - k));
    const std::vector<Place> places = explorer.along(gradient, sigma);
    if (places.empty()) continue;
    bent.bend(-1, explorer.straight_step(gradient, sigma));
    for (const Place& place : places) bent.bend(place.weight, place.from_estimate);
  }
  return bent;
}

}  // namespace plumbline::orient
