// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "firmware/deliver/product.h"

namespace plumbline::deliver {

const orient::MeasuredPoint& point_of(const Product& product, int index);

// The measured points of a product (indices), as people ask for them.
struct PointKinds {
  std::vector<int> named;                 // by hand, or from a table
  std::vector<int> ties;                  // found by matching, named T1, T2, ...
  std::vector<std::string> not_measured;  // named ones with fewer than two good rays
};
PointKinds point_kinds(const Product& product);

// Standard deviations of some points, metres, per axis east, north, up.
struct SigmaFigures {
  Eigen::Vector3d median = Eigen::Vector3d::Zero();
  Eigen::Vector3d largest = Eigen::Vector3d::Zero();
};
// Empty where there are no points. Infinite where a point's is.
std::optional<SigmaFigures> sigma_figures(const Product& product, const std::vector<int>& points);
// The same about the points' own best-fit frame; empty where the solution does not hold it.
std::optional<SigmaFigures> local_sigma_figures(const Product& product,
                                                const std::vector<int>& points);

double median_of(std::vector<double> values);  // 0 for none

// Indices of the photos that were oriented.
std::vector<int> oriented_photos(const Product& product);

// The foot of the climb: below the mean of the stations, at the median height of the points.
Eigen::Vector3d foot_in_enu_m(const Product& product);

// Largest horizontal distance of a named point (or, without any, of 95 % of the ties) from the
// foot, metres.
double reach_m(const Product& product);

// Size of a pixel on the ground from the lowest and from the highest station, metres.
struct GroundSample {
  double finest_m = 0;
  double coarsest_m = 0;
};
std::optional<GroundSample> ground_sample(const Product& product);

// Points by their distance from the foot of the climb, metres, all kinds together.
struct Ring {
  double from_m = 0;
  double to_m = 0;
  int points = 0;
  Eigen::Vector3d median_sigma_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> median_local_sigma_m;
};
std::vector<Ring> rings(const Product& product);

}  // namespace plumbline::deliver
