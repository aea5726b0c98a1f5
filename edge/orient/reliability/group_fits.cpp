// SPDX-License-Identifier: MIT
#include "edge/orient/reliability/group_fits.h"

#include <algorithm>
#include <cmath>

#include "edge/base/median.h"
#include "edge/orient/network/rays.h"

namespace plumbline::orient {
namespace {

constexpr double kMedianOfChiSquare2 = 1.3863;  // 2 ln 2
constexpr double kLeastSigmaPx = 1e-3;          // noise-free input must not divide by zero
constexpr ImageGroup kEstimated[] = {ImageGroup::kTies, ImageGroup::kPicks};

void rescale(Network& network, ImageGroup group, double factor) {
  for (Ray& ray : network.rays) {
    if (ray.group == group) ray.sigma_px = std::max(ray.sigma_px * factor, kLeastSigmaPx);
  }
}

// Of the two coordinates of a ray, the share that is not spent on unknowns, on average.
double mean_redundancy(const Network& network) {
  int rays = 0, points = 0;
  for (int p = 0; p < network.points(); ++p) {
    const int used = used_rays(network, p);
    rays += used;
    points += used > 0 ? 1 : 0;
  }
  const double unknowns = 3.0 * points + 1.0 * network.adjusted_columns();
  return std::clamp(1 - unknowns / std::max(1.0, 2.0 * rays), 0.1, 1.0);
}

}  // namespace

std::string name_of(ImageGroup group) {
  switch (group) {
    case ImageGroup::kTies:
      return "ties";
    case ImageGroup::kPicks:
      return "picks";
    case ImageGroup::kStated:
      break;
  }
  return "stated";
}

void rescale_by_median(Network& network, const State& state) {
  const double redundancy = mean_redundancy(network);
  for (const ImageGroup group : kEstimated) {
    std::vector<double> squares;
    for (const Ray& ray : network.rays) {
      if (ray.used && ray.group == group) squares.push_back(squared_sigmas(ray, state));
    }
    if (squares.empty()) continue;
    const double middle = upper_median(squares);
    if (!std::isfinite(middle)) continue;
    rescale(network, group, std::sqrt(middle / kMedianOfChiSquare2 / redundancy));
  }
}

GroupFits group_fits(const Network& network, const NetworkCovariance& covariance,
                     const std::vector<RayLinear>& rays, const std::vector<Term>& terms) {
  GroupFits fits;
  PointSpread spread;
  int spread_of = -1;
  for (std::size_t k = 0; k < rays.size(); ++k) {
    const int point = network.rays[k].point;
    if (!rays[k].active || !covariance.point(point).measured) continue;
    if (point != spread_of) spread = covariance.spread(point);
    spread_of = point;
    GroupFit& fit = fits[name_of(network.rays[k].group)];
    const Eigen::Matrix2d q =
        covariance.pixel_covariance(network, network.rays[k], rays[k], spread);
    const double sigma = network.rays[k].sigma_px;
    fit.squares += rays[k].residual.squaredNorm() / (sigma * sigma);
    fit.redundancy += 2 - q.trace() * rays[k].information;
    fit.observations += 2;
  }
  for (const Term& term : terms) {
    GroupFit& fit = fits[term.group];
    const Eigen::MatrixXd q = covariance.common()(term.columns, term.columns);
    const Eigen::MatrixXd spent = term.jacobian * q * term.jacobian.transpose() * term.information;
    // A parameter held fixed or left free is no observation.
    const auto count = (term.information.diagonal().array() > 0).count();
    fit.squares += term.residual.dot(term.information * term.residual);
    fit.redundancy += static_cast<double>(count) - spent.trace();
    fit.observations += static_cast<int>(count);
  }
  return fits;
}

double rescale_by_variance(Network& network, const GroupFits& fits) {
  double change = 0;
  for (const ImageGroup group : kEstimated) {
    const auto fit = fits.find(name_of(group));
    if (fit == fits.end() || fit->second.redundancy < 1) continue;
    const double factor = std::sqrt(fit->second.squares / fit->second.redundancy);
    rescale(network, group, factor);
    change = std::max(change, std::abs(factor - 1));
  }
  return change;
}

}  // namespace plumbline::orient
