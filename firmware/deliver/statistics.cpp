// SPDX-License-Identifier: MIT
#include "firmware/deliver/statistics.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::deliver {
namespace {

bool is_tie_name(const std::string& name) {
  return name.size() > 1 && name[0] == 'T' &&
         name.find_first_not_of("0123456789", 1) == std::string::npos;
}

std::vector<bool> only_tie_observations(const Product& product) {
  std::vector<bool> only(product.problem.point_names.size(), true);
  for (const orient::Observation& observation : product.problem.observations)
    if (observation.group != orient::ImageGroup::kTies)
      only[static_cast<std::size_t>(observation.point)] = false;
  return only;
}

Eigen::Vector3d sigmas(const Eigen::Matrix3d& covariance_m2) {
  return covariance_m2.diagonal().cwiseSqrt();
}

// NaN, which has no order, counts as infinite.
double ordered(double value) {
  return std::isnan(value) ? std::numeric_limits<double>::infinity() : value;
}

SigmaFigures figures_of(const std::vector<Eigen::Vector3d>& all) {
  SigmaFigures figures;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> values;
    for (const Eigen::Vector3d& sigma : all) values.push_back(ordered(sigma[axis]));
    figures.median[axis] = median_of(values);
    figures.largest[axis] = *std::max_element(values.begin(), values.end());
  }
  return figures;
}

std::vector<int> all_measured(const Product& product) {
  std::vector<int> all;
  for (std::size_t i = 0; i < product.solution.points.size(); ++i)
    if (product.solution.points[i].measured) all.push_back(static_cast<int>(i));
  return all;
}

double distance_from(const Eigen::Vector3d& foot, const Eigen::Vector3d& place) {
  return (place - foot).head<2>().norm();
}

}  // namespace

const orient::MeasuredPoint& point_of(const Product& product, int index) {
  return product.solution.points[static_cast<std::size_t>(index)];
}

PointKinds point_kinds(const Product& product) {
  const std::vector<bool> only_ties = only_tie_observations(product);
  PointKinds kinds;
  for (std::size_t i = 0; i < product.solution.points.size(); ++i) {
    const bool tie = only_ties[i] && is_tie_name(product.problem.point_names[i]);
    if (product.solution.points[i].measured)
      (tie ? kinds.ties : kinds.named).push_back(static_cast<int>(i));
    else if (!tie)
      kinds.not_measured.push_back(product.problem.point_names[i]);
  }
  return kinds;
}

std::optional<SigmaFigures> sigma_figures(const Product& product, const std::vector<int>& points) {
  std::vector<Eigen::Vector3d> all;
  for (const int i : points) all.push_back(sigmas(point_of(product, i).covariance_m2));
  if (all.empty()) return std::nullopt;
  return figures_of(all);
}

std::optional<SigmaFigures> local_sigma_figures(const Product& product,
                                                const std::vector<int>& points) {
  std::vector<Eigen::Vector3d> all;
  for (const int i : points) {
    const Eigen::Matrix3d& local = point_of(product, i).local_covariance_m2;
    if (local.allFinite() && local.diagonal().minCoeff() > 0.0) all.push_back(sigmas(local));
  }
  if (all.empty()) return std::nullopt;
  return figures_of(all);
}

double median_of(std::vector<double> values) {
  if (values.empty()) return 0.0;
  const std::size_t middle = values.size() / 2;
  std::sort(values.begin(), values.end());
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

std::vector<int> oriented_photos(const Product& product) {
  std::vector<int> photos;
  for (std::size_t i = 0; i < product.solution.photos.size(); ++i)
    if (product.solution.photos[i].oriented) photos.push_back(static_cast<int>(i));
  return photos;
}

Eigen::Vector3d foot_in_enu_m(const Product& product) {
  Eigen::Vector3d foot = Eigen::Vector3d::Zero();
  const std::vector<int> photos = oriented_photos(product);
  for (const int i : photos)
    foot += product.solution.photos[static_cast<std::size_t>(i)].pose.centre_m /
            static_cast<double>(photos.size());
  std::vector<double> heights;
  for (const int i : all_measured(product)) heights.push_back(point_of(product, i).in_enu_m.z());
  foot.z() = median_of(heights);
  return foot;
}

double reach_m(const Product& product) {
  const PointKinds kinds = point_kinds(product);
  const bool by_name = !kinds.named.empty();
  const Eigen::Vector3d foot = foot_in_enu_m(product);
  std::vector<double> distances;
  for (const int i : by_name ? kinds.named : kinds.ties)
    distances.push_back(distance_from(foot, point_of(product, i).in_enu_m));
  if (distances.empty()) return 0.0;
  std::sort(distances.begin(), distances.end());
  return by_name ? distances.back() : distances[(distances.size() - 1) * 95 / 100];
}

std::optional<GroundSample> ground_sample(const Product& product) {
  const double f_px = product.solution.camera.interior[geometry::kFocalLength];
  const Eigen::Vector3d foot = foot_in_enu_m(product);
  std::vector<double> sizes_m;
  for (const int i : oriented_photos(product))
    sizes_m.push_back(
        (product.solution.photos[static_cast<std::size_t>(i)].pose.centre_m.z() - foot.z()) / f_px);
  if (sizes_m.empty() || !(f_px > 0.0)) return std::nullopt;
  const auto [finest, coarsest] = std::minmax_element(sizes_m.begin(), sizes_m.end());
  if (!(*finest > 0.0)) return std::nullopt;
  return GroundSample{*finest, *coarsest};
}

std::vector<Ring> rings(const Product& product) {
  const std::vector<double> edges_m = {0, 5, 10, 20, 30, 50, 100, 200, 1e9};
  const Eigen::Vector3d foot = foot_in_enu_m(product);
  std::vector<Ring> all;
  for (std::size_t r = 0; r + 1 < edges_m.size(); ++r) {
    std::vector<int> inside;
    for (const int i : all_measured(product)) {
      const double distance = distance_from(foot, point_of(product, i).in_enu_m);
      if (distance >= edges_m[r] && distance < edges_m[r + 1]) inside.push_back(i);
    }
    if (inside.empty()) continue;
    Ring ring{edges_m[r], edges_m[r + 1], static_cast<int>(inside.size()),
              sigma_figures(product, inside)->median, std::nullopt};
    if (const auto local = local_sigma_figures(product, inside))
      ring.median_local_sigma_m = local->median;
    all.push_back(ring);
  }
  return all;
}

}  // namespace plumbline::deliver
