// SPDX-License-Identifier: MIT
#include "edge/orient/findings/observation_residuals.h"

#include <cmath>

namespace plumbline::orient {
namespace {

// The residual of an observation that took part has covariance s2 I - Q, of one that did not
// s2 I + Q, with Q that of the computed pixel.
void test(const RayLinear& ray, const Eigen::Matrix2d& computed, ObservationResidual& out) {
  const double variance = 1 / ray.information;
  for (int i = 0; i < 2; ++i) {
    const double q = computed(i, i);
    const double own = out.used ? variance - q : variance + q;
    if (out.used) out.redundancy[i] = std::max(0.0, 1 - q / variance);
    if (own > 1e-9 * variance) out.w[i] = out.residual_px[i] / std::sqrt(own);
  }
}

}  // namespace

std::vector<ObservationResidual> observation_residuals(const Finished& f) {
  std::vector<ObservationResidual> out(f.network.problem->observations.size());
  Network all = f.network;
  for (Ray& ray : all.rays) ray.used = true;
  const RaysLinear linear = linearise_rays(all, f.state, 0);
  PointSpread spread;
  int spread_of = -1;
  for (std::size_t k = 0; k < all.rays.size(); ++k) {
    const Ray& ray = f.network.rays[k];
    ObservationResidual& residual = out[at(ray.observation)];
    residual.sigma_px = ray.sigma_px;
    residual.used = ray.used;
    if (!linear.rays[k].active) continue;
    residual.residual_px = -linear.rays[k].residual;
    if (!f.covariance.point(ray.point).measured) continue;
    if (ray.point != spread_of) spread = f.covariance.spread(ray.point);
    spread_of = ray.point;
    test(linear.rays[k], f.covariance.pixel_covariance(f.network, ray, linear.rays[k], spread),
         residual);
  }
  return out;
}

}  // namespace plumbline::orient
