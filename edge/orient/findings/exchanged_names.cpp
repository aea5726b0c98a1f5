// SPDX-License-Identifier: MIT
#include "edge/orient/findings/exchanged_names.h"

#include <Eigen/LU>
#include <algorithm>
#include <map>

#include "edge/base/chi_square.h"

namespace plumbline::orient {
namespace {

// A pair fits where each half passes at this share: a pair by chance is far rarer than that.
constexpr double kFits = 0.999;

// Does the measurement of ray `a` fit the point of ray `b`, of the same photo?
bool fits(const Finished& f, const Ray& a, const Ray& b) {
  Ray other = a;
  other.point = b.point;
  const auto residual = residual_of(other, f.state);
  if (!residual) return false;
  // The predicted pixel has an uncertainty of its own; a point in the network has a few pixels at
  // most, which the factor covers without letting a neighbour in.
  constexpr double kPredicted = 2;
  const double sigma = kPredicted * a.sigma_px;
  return residual->squaredNorm() / (sigma * sigma) < chi_square_quantile(kFits, 2);
}

void add_exchanged_rays(const Finished& f, std::vector<Blunder>& out) {
  const auto& names = f.network.problem->point_names;
  std::map<int, std::vector<const Ray*>> by_photo;
  for (const Ray& ray : f.network.rays) {
    if (!ray.used && f.covariance.point(ray.point).measured) by_photo[ray.slot].push_back(&ray);
  }
  for (const auto& [slot, rays] : by_photo) {
    for (std::size_t i = 0; i < rays.size(); ++i) {
      for (std::size_t j = i + 1; j < rays.size(); ++j) {
        if (!fits(f, *rays[i], *rays[j]) || !fits(f, *rays[j], *rays[i])) continue;
        const std::string pair = names[at(rays[i]->point)] + " and " + names[at(rays[j]->point)];
        out.push_back({"exchanged_names", pair,
                       "In photo " + f.network.photo(slot).name + " the points " + pair +
                           " bear each other's names: neither measurement was used.",
                       0, 0, 0});
      }
    }
  }
}

bool fits(const Finished& f, const Control& place, int point) {
  if (!f.covariance.point(point).measured) return false;
  const Eigen::Vector3d miss = f.state.points[at(point)] - place.in_enu_m;
  const Eigen::Matrix3d spread = place.covariance_m2 + f.covariance.point_covariance(point);
  return miss.dot(spread.inverse() * miss) < chi_square_quantile(kFits, 3);
}

void add_exchanged_control(const Finished& f, std::vector<Blunder>& out) {
  const Problem& problem = *f.network.problem;
  std::vector<const Control*> rejected;
  for (const Claim& claim : f.rejected) {
    if (claim.kind == ClaimKind::kControl) rejected.push_back(&problem.control[at(claim.index)]);
  }
  for (std::size_t i = 0; i < rejected.size(); ++i) {
    for (std::size_t j = i + 1; j < rejected.size(); ++j) {
      const Control &a = *rejected[i], &b = *rejected[j];
      if (!fits(f, a, b.point) || !fits(f, b, a.point)) continue;
      const auto [first, second] = std::minmax(a.point, b.point);
      const std::string pair =
          problem.point_names[at(first)] + " and " + problem.point_names[at(second)];
      out.push_back({"exchanged_names", pair,
                     "The control points " + pair +
                         " bear each other's coordinates: neither was "
                         "used.",
                     (a.in_enu_m - b.in_enu_m).norm(), 0, 0});
    }
  }
}

}  // namespace

std::vector<Blunder> exchanged_names(const Finished& finished) {
  std::vector<Blunder> out;
  add_exchanged_rays(finished, out);
  add_exchanged_control(finished, out);
  return out;
}

}  // namespace plumbline::orient
