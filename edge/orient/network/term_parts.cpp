// SPDX-License-Identifier: MIT
#include "edge/orient/network/term_parts.h"

#include <cmath>
#include <numbers>

namespace plumbline::orient {

double wrapped(double angle_rad) { return std::remainder(angle_rad, 2 * std::numbers::pi); }

geometry::OmegaPhiKappa angles(const State& state, int slot) {
  return geometry::angles_of(state.poses[at(slot)].ground_from_photo);
}

Eigen::Matrix3d angles_by_increment(const State& state, int slot) {
  return geometry::angles_by_ground_increment(angles(state, slot));
}

std::vector<int> range(int first, int count) {
  std::vector<int> columns(at(count));
  for (int i = 0; i < count; ++i) columns[at(i)] = first + i;
  return columns;
}

Term scalar_term(const char* group, std::vector<int> columns, double residual, double sigma) {
  Term term{group, std::move(columns), Eigen::VectorXd::Constant(1, residual), {}, {}};
  term.jacobian.setZero(1, static_cast<Eigen::Index>(term.columns.size()));
  term.information = Eigen::MatrixXd::Constant(1, 1, 1 / (sigma * sigma));
  return term;
}

}  // namespace plumbline::orient
