// SPDX-License-Identifier: MIT
#include "edge/orient/derived.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "edge/base/index.h"

namespace plumbline::orient {
namespace {

using Corners = std::vector<Eigen::Vector3d>;
using Triangle = std::array<int, 3>;

double cross(const Eigen::Vector3d& a, const Eigen::Vector3d& b, const Eigen::Vector3d& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (c.x() - a.x()) * (b.y() - a.y());
}

Result<Corners> places(const Solution& solution, const std::vector<int>& points,
                       std::size_t least) {
  if (points.size() < least)
    return Error{"At least " + std::to_string(least) + " points are needed."};
  Corners out;
  for (const int point : points) {
    if (point < 0 || point >= static_cast<int>(solution.points.size()) ||
        !solution.points[at(point)].measured)
      return Error{"One of the points was not measured."};
    out.push_back(solution.points[at(point)].in_enu_m);
  }
  return out;
}

bool crosses(const Corners& p, std::size_t i, std::size_t j) {
  const auto &a = p[i], &b = p[(i + 1) % p.size()], &c = p[j], &d = p[(j + 1) % p.size()];
  return cross(a, b, c) * cross(a, b, d) < 0 && cross(c, d, a) * cross(c, d, b) < 0;
}

Status simple(const Corners& p) {
  for (std::size_t i = 0; i < p.size(); ++i) {
    for (std::size_t j = i + 1; j < p.size(); ++j) {
      if (crosses(p, i, j))
        return Error{"The sides of the polygon cross: name its corners in their order around it."};
    }
  }
  return Done{};
}

double signed_area(const Corners& p) {
  double sum = 0;
  for (std::size_t i = 0; i < p.size(); ++i) {
    const auto& next = p[(i + 1) % p.size()];
    sum += p[i].x() * next.y() - next.x() * p[i].y();
  }
  return sum / 2;
}

bool within(const Eigen::Vector3d& p, const Eigen::Vector3d& a, const Eigen::Vector3d& b,
            const Eigen::Vector3d& c) {
  return cross(a, b, p) >= 0 && cross(b, c, p) >= 0 && cross(c, a, p) >= 0;
}

// `left`: corners that are not cut off yet, counter-clockwise.
bool is_ear(const Corners& p, const std::vector<int>& left, std::size_t k) {
  const std::size_t n = left.size();
  const int before = left[(k + n - 1) % n], here = left[k], after = left[(k + 1) % n];
  if (cross(p[at(before)], p[at(here)], p[at(after)]) <= 0) return false;
  for (const int other : left) {
    if (other == before || other == here || other == after) continue;
    if (within(p[at(other)], p[at(before)], p[at(here)], p[at(after)])) return false;
  }
  return true;
}

std::vector<Triangle> triangles(const Corners& p) {
  std::vector<int> left;
  for (int i = 0; i < static_cast<int>(p.size()); ++i) left.push_back(i);
  if (signed_area(p) < 0) std::reverse(left.begin(), left.end());
  std::vector<Triangle> out;
  while (left.size() > 3) {
    std::size_t ear = 0;
    while (ear < left.size() && !is_ear(p, left, ear)) ++ear;
    if (ear == left.size()) ear = 0;  // corners on one line: an ear of no area
    const std::size_t n = left.size();
    out.push_back({left[(ear + n - 1) % n], left[ear], left[(ear + 1) % n]});
    left.erase(left.begin() + static_cast<std::ptrdiff_t>(ear));
  }
  out.push_back({left[0], left[1], left[2]});
  return out;
}

Derived with_sigma(const Solution& solution, const std::vector<int>& points, double value,
                   const Eigen::VectorXd& jacobian) {
  const double variance = jacobian.dot(solution.covariances->joint(points) * jacobian);
  return {value, std::sqrt(std::max(0.0, variance)), jacobian};
}

// A triangle's area by the plan coordinates of its corners, times `factor`.
void add_area_slope(const Corners& p, const Triangle& t, double factor, Eigen::VectorXd& jacobian) {
  for (int k = 0; k < 3; ++k) {
    const auto &next = p[at(t[at((k + 1) % 3)])], &before = p[at(t[at((k + 2) % 3)])];
    const Eigen::Index place = 3 * t[at(k)];
    jacobian[place] += factor * (next.y() - before.y()) / 2;
    jacobian[place + 1] += factor * (before.x() - next.x()) / 2;
  }
}

}  // namespace

Result<Derived> distance(const Solution& solution, int a, int b) {
  const auto p = places(solution, {a, b}, 2);
  if (!p) return p.error();
  const Eigen::Vector3d difference = (*p)[1] - (*p)[0];
  const double metres = difference.norm();
  if (!(metres > 0)) return Error{"A distance needs two different points."};
  Eigen::VectorXd jacobian(6);
  jacobian << -difference / metres, difference / metres;
  return with_sigma(solution, {a, b}, metres, jacobian);
}

Result<Derived> area(const Solution& solution, const std::vector<int>& corners) {
  const auto p = places(solution, corners, 3);
  if (!p) return p.error();
  if (const Status status = simple(*p); !status) return status.error();
  const double sign = signed_area(*p) < 0 ? -1 : 1;
  const std::size_t n = p->size();
  Eigen::VectorXd jacobian = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * n));
  for (std::size_t i = 0; i < n; ++i) {
    const auto &next = (*p)[(i + 1) % n], &before = (*p)[(i + n - 1) % n];
    jacobian[static_cast<Eigen::Index>(3 * i)] = sign * (next.y() - before.y()) / 2;
    jacobian[static_cast<Eigen::Index>(3 * i + 1)] = sign * (before.x() - next.x()) / 2;
  }
  return with_sigma(solution, corners, std::abs(signed_area(*p)), jacobian);
}

Result<Derived> volume(const Solution& solution, const std::vector<int>& corners, double level_m) {
  const auto p = places(solution, corners, 3);
  if (!p) return p.error();
  if (const Status status = simple(*p); !status) return status.error();
  Eigen::VectorXd jacobian = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(3 * p->size()));
  double sum = 0;
  for (const Triangle& t : triangles(*p)) {
    const auto &a = (*p)[at(t[0])], &b = (*p)[at(t[1])], &c = (*p)[at(t[2])];
    const double plan = cross(a, b, c) / 2;
    const double high = (a.z() + b.z() + c.z()) / 3 - level_m;
    sum += plan * high;
    add_area_slope(*p, t, high, jacobian);
    for (const int corner : t) jacobian[3 * corner + 2] += plan / 3;
  }
  return with_sigma(solution, corners, sum, jacobian);
}

}  // namespace plumbline::orient
