// SPDX-License-Identifier: MIT
#include "edge/orient/reliability/reliability.h"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>

#include "edge/base/chi_square.h"

namespace plumbline::orient {
namespace {

// Below this share of redundancy, rounding decides.
constexpr double kNumericalRedundancy = 1e-8;

// Modes m with M' own M = I and M' spread M = diag(share).
struct Modes {
  Eigen::VectorXd share;
  Eigen::MatrixXd modes;
};

Modes modes_of(const Eigen::MatrixXd& spread, const Eigen::MatrixXd& own) {
  const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(
      0.5 * (spread + spread.transpose()), 0.5 * (own + own.transpose()));
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

Threshold threshold(int dof, double share) {
  if (dof <= 0 || share <= 0) return {};
  const double each = -std::expm1(std::log1p(-kFalseAlarms) * share);
  const double critical = chi_square_quantile(1 - each, dof);
  return {critical, noncentrality_for_power(critical, dof, kPower)};
}

Eigen::VectorXd minimal_detectable(const RowsTest& test, double noncentrality) {
  Eigen::VectorXd smallest =
      Eigen::VectorXd::Constant(test.detectability.rows(), std::numeric_limits<double>::infinity());
  for (Eigen::Index i = 0; i < smallest.size(); ++i) {
    const double d = test.detectability(i, i);
    if (test.dof > 0 && d > 0) smallest[i] = std::sqrt(noncentrality / d);
  }
  return smallest;
}

TermReliability::TermReliability(const Term& term, const NetworkCovariance& covariance)
    : term_(term),
      adjusted_(term.jacobian * covariance.common()(term.columns, term.columns) *
                term.jacobian.transpose()),
      spread_(term.information - term.information * adjusted_ * term.information),
      weighted_(term.information * term.residual) {}

RowsTest TermReliability::test(int first, int count) const {
  const Eigen::MatrixXd own = term_.information.block(first, first, count, count);
  const Eigen::MatrixXd spread = spread_.block(first, first, count, count);
  const Modes m = modes_of(spread, own);
  RowsTest out;
  out.redundancy = spread.diagonal().cwiseQuotient(own.diagonal()).cwiseMax(0);
  out.detectability.setZero(count, count);
  out.gross_error.setZero(count);
  const Eigen::VectorXd v = m.modes.transpose() * weighted_.segment(first, count);
  for (int i = 0; i < count; ++i) {
    out.least_redundancy = std::min(out.least_redundancy, std::max(m.share[i], 0.0));
    if (m.share[i] < kLeastRedundancy) continue;
    ++out.dof;
    out.statistic += v[i] * v[i] / m.share[i];
    const Eigen::VectorXd along = own * m.modes.col(i);
    out.detectability += m.share[i] * along * along.transpose();
    out.gross_error -= m.modes.col(i) * (v[i] / m.share[i]);
  }
  return out;
}

// With P of all rows, P_kk^-1 (P r)_k is what the rows miss by once the others have said what they
// know of a common error, and P_kk^-1 its covariance (conditional normal distribution).
RowsTest TermReliability::test_outside(int first, int count) const {
  const Eigen::MatrixXd own = term_.information.block(first, first, count, count);
  const Eigen::MatrixXd predicted = term_.information.middleRows(first, count) * adjusted_ *
                                    term_.information.middleCols(first, count);
  const Modes m = modes_of(predicted, own);
  RowsTest out;
  out.redundancy.setZero(count);
  out.detectability.setZero(count, count);
  out.gross_error.setZero(count);
  const Eigen::VectorXd v = m.modes.transpose() * weighted_.segment(first, count);
  for (int i = 0; i < count; ++i) {
    const double share = 1 / (1 + m.share[i]);
    out.least_redundancy = std::min(out.least_redundancy, share);
    const Eigen::VectorXd along = own * m.modes.col(i);
    out.redundancy += share * along.cwiseAbs2().cwiseQuotient(own.diagonal());
    if (share < kLeastRedundancy) continue;
    ++out.dof;
    out.statistic += v[i] * v[i] * share;
    out.detectability += share * along * along.transpose();
    out.gross_error -= m.modes.col(i) * v[i];
  }
  return out;
}

Eigen::MatrixXd TermReliability::influence(int first, int count) const {
  return term_.jacobian.transpose() * term_.information.middleCols(first, count);
}

// A free error g of the rows adds  H' G D^-1 G' H  to the covariance of H' x, with
// G = C A' P E and D = E' (P - P A C A' P) E: the inverse of the bordered normal matrix.
Eigen::MatrixXd TermReliability::lost_without(int first, int count,
                                              const Eigen::MatrixXd& covariance_with) const {
  const Eigen::MatrixXd pulled =
      covariance_with(term_.columns, Eigen::all).transpose() * influence(first, count);
  const Modes m = modes_of(spread_.block(first, first, count, count),
                           term_.information.block(first, first, count, count));
  const Eigen::MatrixXd by_mode = pulled * m.modes;
  const Eigen::VectorXd divisor = m.share.cwiseMax(kNumericalRedundancy).cwiseInverse();
  return by_mode * divisor.asDiagonal() * by_mode.transpose();
}

}  // namespace plumbline::orient
