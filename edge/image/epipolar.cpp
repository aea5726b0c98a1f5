// SPDX-License-Identifier: MIT
#include "edge/image/epipolar.h"

#include <Eigen/Eigenvalues>
#include <Eigen/SVD>
#include <algorithm>
#include <cmath>
#include <optional>
#include <random>

#include "edge/base/median.h"

namespace plumbline::image {
namespace {

constexpr std::size_t kFewestMatches = 20;
constexpr int kTrials = 120;
constexpr double kConsensus_px = 2.5;  // in pixels of the coarser photo
constexpr std::size_t kNeighbours = 12;
constexpr double kLeastLimit_px = 1.0;
constexpr double kLimitInSigmas = 5.0;

struct Frame {
  Eigen::Vector2d mean = Eigen::Vector2d::Zero();
  double scale = 1;
  Eigen::Vector3d operator()(const Eigen::Vector2d& pixel) const {
    return (scale * (pixel - mean)).homogeneous();
  }
};

Frame frame_of(const std::vector<Correspondence>& matches, Eigen::Vector2d Correspondence::*side) {
  Frame frame;
  for (const Correspondence& match : matches) frame.mean += match.*side;
  frame.mean /= static_cast<double>(matches.size());
  double distance = 0;
  for (const Correspondence& match : matches) distance += (match.*side - frame.mean).norm();
  frame.scale = std::sqrt(2.0) * static_cast<double>(matches.size()) / std::max(distance, 1e-9);
  return frame;
}

struct NormalisedMatch {
  Eigen::Vector3d first;
  Eigen::Vector3d second;
};

Eigen::Matrix3d eight_point(const std::vector<NormalisedMatch>& matches,
                            const std::vector<std::size_t>& chosen) {
  Eigen::Matrix<double, 9, 9> normal = Eigen::Matrix<double, 9, 9>::Zero();
  for (const std::size_t index : chosen) {
    const NormalisedMatch& m = matches[index];
    Eigen::Matrix<double, 9, 1> row;
    row << m.second.x() * m.first, m.second.y() * m.first, m.second.z() * m.first;
    normal += row * row.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 9, 9>> solver(normal);
  const Eigen::Matrix<double, 9, 1> f = solver.eigenvectors().col(0);
  Eigen::Matrix3d matrix;
  matrix << f.segment<3>(0).transpose(), f.segment<3>(3).transpose(), f.segment<3>(6).transpose();
  Eigen::JacobiSVD<Eigen::Matrix3d> svd(matrix, Eigen::ComputeFullU | Eigen::ComputeFullV);
  Eigen::Vector3d values = svd.singularValues();
  values(2) = 0;
  return svd.matrixU() * values.asDiagonal() * svd.matrixV().transpose();
}

// Signed distances of the second points from their epipolar lines, in normalised units.
std::vector<double> distances(const Eigen::Matrix3d& fundamental,
                              const std::vector<NormalisedMatch>& matches) {
  std::vector<double> result;
  for (const NormalisedMatch& m : matches) {
    const Eigen::Vector3d line = fundamental * m.first;
    result.push_back(m.second.dot(line) / std::max(line.head<2>().norm(), 1e-12));
  }
  return result;
}

std::vector<std::size_t> within(const std::vector<double>& distance, double limit) {
  std::vector<std::size_t> inside;
  for (std::size_t i = 0; i < distance.size(); ++i)
    if (std::abs(distance[i]) < limit) inside.push_back(i);
  return inside;
}

std::optional<std::vector<double>> consensus_distances(const std::vector<NormalisedMatch>& matches,
                                                       double limit, std::uint64_t seed) {
  std::mt19937_64 generator(seed);
  std::vector<std::size_t> best;
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<std::size_t> sample;
    while (sample.size() < 8) {
      const std::size_t index = generator() % matches.size();
      if (std::find(sample.begin(), sample.end(), index) == sample.end()) sample.push_back(index);
    }
    auto inside = within(distances(eight_point(matches, sample), matches), limit);
    if (inside.size() > best.size()) best = std::move(inside);
  }
  if (best.size() < kFewestMatches / 2) return std::nullopt;
  for (int round = 0; round < 3; ++round) {
    auto inside = within(distances(eight_point(matches, best), matches), limit);
    if (inside.size() < best.size()) break;
    best = std::move(inside);
  }
  return distances(eight_point(matches, best), matches);
}

// Each distance less the median of its neighbours'.
std::vector<double> without_trend(const std::vector<Correspondence>& matches,
                                  const std::vector<double>& distance) {
  std::vector<double> result;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    std::vector<std::pair<double, std::size_t>> others;
    for (std::size_t k = 0; k < matches.size(); ++k) {
      if (k != i) others.emplace_back((matches[k].first_px - matches[i].first_px).squaredNorm(), k);
    }
    const std::size_t count = std::min(kNeighbours, others.size());
    std::partial_sort(others.begin(), others.begin() + static_cast<std::ptrdiff_t>(count),
                      others.end());
    std::vector<double> near;
    for (std::size_t n = 0; n < count; ++n) near.push_back(distance[others[n].second]);
    result.push_back(distance[i] - upper_median(std::move(near)));
  }
  return result;
}

}  // namespace

std::vector<bool> off_epipolar_line(const std::vector<Correspondence>& matches, double pixel_px,
                                    std::uint64_t seed) {
  std::vector<bool> suspect(matches.size(), false);
  if (matches.size() < kFewestMatches) return suspect;
  const Frame first = frame_of(matches, &Correspondence::first_px);
  const Frame second = frame_of(matches, &Correspondence::second_px);
  std::vector<NormalisedMatch> normalised;
  for (const Correspondence& match : matches)
    normalised.push_back({first(match.first_px), second(match.second_px)});
  const double unit = second.scale * pixel_px;
  const auto distance = consensus_distances(normalised, kConsensus_px * unit, seed);
  if (!distance) return suspect;
  const std::vector<double> rest = without_trend(matches, *distance);
  std::vector<double> size;
  for (const double value : rest) size.push_back(std::abs(value));
  const double sigma = 1.4826 * upper_median(size);
  const double limit = std::max(kLeastLimit_px * unit, kLimitInSigmas * sigma);
  for (std::size_t i = 0; i < rest.size(); ++i) suspect[i] = std::abs(rest[i]) > limit;
  return suspect;
}

}  // namespace plumbline::image
