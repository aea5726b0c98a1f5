// SPDX-License-Identifier: MIT
#include "edge/orient/reliability/image_correlation.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "edge/orient/network/normal_equations.h"

namespace plumbline::orient {
namespace {

constexpr int kCellsAcross = 8;
constexpr int kCellsDown = 6;
constexpr double kSignificantSigmas = 3;

struct Cell {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  double squares = 0;
  int rays = 0;
};

int part(double pixel, int size_px, int parts) {
  return std::clamp(static_cast<int>(pixel / size_px * parts), 0, parts - 1);
}

std::size_t cell_of(const Ray& ray, const geometry::Camera& camera) {
  const int across = part(ray.pixel.x(), camera.width_px, kCellsAcross);
  const int down = part(ray.pixel.y(), camera.height_px, kCellsDown);
  return static_cast<std::size_t>((ray.slot * kCellsDown + down) * kCellsAcross + across);
}

std::vector<Cell> cells_of(const Network& network, const State& state) {
  std::vector<Cell> cells(static_cast<std::size_t>(network.slots() * kCellsAcross * kCellsDown));
  for (const Ray& ray : network.rays) {
    if (!ray.used || ray.group != ImageGroup::kTies) continue;
    const auto residual = residual_of(ray, state);
    if (!residual) continue;
    Cell& cell = cells[cell_of(ray, network.problem->camera)];
    const Eigen::Vector2d in_sigmas = *residual / ray.sigma_px;
    cell.sum += in_sigmas;
    cell.squares += in_sigmas.squaredNorm();
    ++cell.rays;
  }
  return cells;
}

}  // namespace

ImageCorrelation image_correlation(const Network& network, const State& state) {
  double products = 0, squares = 0, pairs = 0, rays = 0, rays_squared = 0;
  for (const Cell& cell : cells_of(network, state)) {
    const double n = cell.rays;
    products += cell.sum.squaredNorm() - cell.squares;
    squares += cell.squares;
    pairs += n * (n - 1);
    rays += n;
    rays_squared += n * n;
  }
  ImageCorrelation found;
  if (pairs < 1 || !(squares > 0)) return found;
  found.intraclass = (products / pairs) / (squares / rays);
  // Of n (n - 1) ordered pairs half are different; two coordinates each.
  const double chance = 1 / std::sqrt(pairs);
  if (found.intraclass <= kSignificantSigmas * chance) return found;
  found.design_effect = 1 + (rays_squared / rays - 1) * found.intraclass;
  return found;
}

}  // namespace plumbline::orient
