// SPDX-License-Identifier: MIT
#include "edge/image/homography.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <random>

namespace plumbline::image {
namespace {

constexpr int kMostTrials = 3000;
constexpr double kWantedConfidence = 0.9999;

// Moves points to their centroid and scales them to a mean distance of sqrt 2.
Eigen::Matrix3d normaliser(const std::vector<Correspondence>& points,
                           Eigen::Vector2d Correspondence::*side) {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  for (const Correspondence& point : points) mean += point.*side;
  mean /= static_cast<double>(points.size());
  double distance = 0;
  for (const Correspondence& point : points) distance += (point.*side - mean).norm();
  const double scale =
      std::sqrt(2.0) * static_cast<double>(points.size()) / std::max(distance, 1e-9);
  Eigen::Matrix3d matrix;
  matrix << scale, 0, -scale * mean.x(), 0, scale, -scale * mean.y(), 0, 0, 1;
  return matrix;
}

bool plausible(const Eigen::Matrix3d& homography, const std::vector<Correspondence>& points) {
  for (const Correspondence& point : points) {
    const LocalMap map = local_map(homography, point.first_px);
    const double scale = scale_of(map.jacobian);
    if (!(map.jacobian.determinant() > 0) || !(scale > 0.25 && scale < 4)) return false;
    const double stretch = map.jacobian.squaredNorm() / (scale * scale);
    if (!(stretch < 2.6)) return false;  // 2 for a similarity
  }
  return true;
}

std::vector<int> within(const Eigen::Matrix3d& homography,
                        const std::vector<Correspondence>& points, double tolerance_px) {
  std::vector<int> inliers;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Eigen::Vector2d miss = transform(homography, points[i].first_px) - points[i].second_px;
    if (miss.norm() < tolerance_px) inliers.push_back(static_cast<int>(i));
  }
  return inliers;
}

std::vector<Correspondence> pick(const std::vector<Correspondence>& points,
                                 const std::vector<int>& indices) {
  std::vector<Correspondence> picked;
  for (const int index : indices) picked.push_back(points[static_cast<std::size_t>(index)]);
  return picked;
}

std::vector<int> draw_four(std::mt19937_64& generator, std::size_t count) {
  std::vector<int> drawn;
  while (drawn.size() < 4) {
    const int index = static_cast<int>(generator() % count);
    if (std::find(drawn.begin(), drawn.end(), index) == drawn.end()) drawn.push_back(index);
  }
  return drawn;
}

int trials_needed(double inlier_share) {
  const double all_good = std::pow(inlier_share, 4);
  if (all_good > 1 - 1e-9) return 1;
  const double trials = std::log(1 - kWantedConfidence) / std::log(1 - std::max(all_good, 1e-9));
  return static_cast<int>(std::min<double>(trials + 1, kMostTrials));
}

}  // namespace

Eigen::Vector2d transform(const Eigen::Matrix3d& homography, const Eigen::Vector2d& pixel) {
  return (homography * pixel.homogeneous()).hnormalized();
}

LocalMap local_map(const Eigen::Matrix3d& homography, const Eigen::Vector2d& pixel) {
  const Eigen::Vector3d image = homography * pixel.homogeneous();
  LocalMap map{pixel, image.hnormalized(), {}};
  for (int axis = 0; axis < 2; ++axis) {
    map.jacobian.row(axis) =
        (homography.block<1, 2>(axis, 0) - map.target_px(axis) * homography.block<1, 2>(2, 0)) /
        image.z();
  }
  return map;
}

std::optional<Eigen::Matrix3d> fit_homography(const std::vector<Correspondence>& points) {
  if (points.size() < 4) return std::nullopt;
  const Eigen::Matrix3d first = normaliser(points, &Correspondence::first_px);
  const Eigen::Matrix3d second = normaliser(points, &Correspondence::second_px);
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (const Correspondence& point : points) {
    const Eigen::Vector3d x = first * point.first_px.homogeneous();
    const Eigen::Vector3d y = second * point.second_px.homogeneous();
    Eigen::Matrix<double, 2, 9> rows = Eigen::Matrix<double, 2, 9>::Zero();
    rows.block<1, 3>(0, 0) = x.transpose();
    rows.block<1, 3>(0, 6) = -y.x() * x.transpose();
    rows.block<1, 3>(1, 3) = x.transpose();
    rows.block<1, 3>(1, 6) = -y.y() * x.transpose();
    normal += rows.transpose() * rows;
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  const Eigen::Matrix<double, 9, 1> h = solver.eigenvectors().col(0);
  Eigen::Matrix3d matrix;
  matrix << h.segment<3>(0).transpose(), h.segment<3>(3).transpose(), h.segment<3>(6).transpose();
  matrix = second.inverse() * matrix * first;
  if (!matrix.allFinite() || std::abs(matrix(2, 2)) < 1e-12) return std::nullopt;
  return matrix / matrix(2, 2);
}

std::optional<HomographyConsensus> find_homography(const std::vector<Correspondence>& points,
                                                   double tolerance_px, std::uint64_t seed) {
  if (points.size() < 4) return std::nullopt;
  std::mt19937_64 generator(seed);
  HomographyConsensus best;
  int trials = kMostTrials;
  for (int trial = 0; trial < trials; ++trial) {
    const auto sample = pick(points, draw_four(generator, points.size()));
    const auto homography = fit_homography(sample);
    if (!homography || !plausible(*homography, sample)) continue;
    std::vector<int> inliers = within(*homography, points, tolerance_px);
    if (inliers.size() <= best.inliers.size()) continue;
    best = {*homography, std::move(inliers)};
    trials = trials_needed(static_cast<double>(best.inliers.size()) /
                           static_cast<double>(points.size()));
  }
  for (int round = 0; round < 5 && best.inliers.size() >= 4; ++round) {
    const auto refined = fit_homography(pick(points, best.inliers));
    if (!refined) break;
    std::vector<int> inliers = within(*refined, points, tolerance_px);
    if (inliers.size() < best.inliers.size()) break;
    best = {*refined, std::move(inliers)};
  }
  if (best.inliers.size() < 4 || !plausible(best.second_from_first, pick(points, best.inliers)))
    return std::nullopt;
  return best;
}

}  // namespace plumbline::image
