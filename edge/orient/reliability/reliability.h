// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>

#include "edge/orient/network/terms.h"
#include "edge/orient/precision/covariance.h"

namespace plumbline::orient {

// How sure a flight is to be told of nothing that is not there, and of what is: the false alarms of
// a group (all stations, all lengths, ...) per adjustment, and the power for which the smallest
// detectable error is stated.
inline constexpr double kFalseAlarms = 0.01;
inline constexpr double kPower = 0.99;
// Directions of which less than this share is redundant are not tested: only an error of more than
// six hundred sigmas would show, and what is linear no more.
inline constexpr double kLeastRedundancy = 1e-4;

// The test of some rows of a term for a gross error, by chi-square over the directions in which the
// rest of the network checks them (Baarda 1968; correlated observations: Wang and Chen 1994).
struct RowsTest {
  int dof = 0;  // directions that can be checked; 0: none
  double statistic = 0;
  // The non-centrality of the statistic under an error g of the rows is g' detectability g.
  Eigen::MatrixXd detectability;
  Eigen::VectorXd redundancy;   // of each row, 0 (not checked at all) to 1
  Eigen::VectorXd gross_error;  // its estimate (known minus true), in the directions tested
  // Redundancy of the direction in which the rows are checked least, tested or not.
  double least_redundancy = 1;
};

// The critical value and the non-centrality of the power wanted, for a test that has this share of
// kFalseAlarms: it gets 1 - (1 - alpha)^share (Sidak 1967).
struct Threshold {
  double critical = 0;
  double noncentrality = 0;
};
Threshold threshold(int dof, double share);

// The smallest error of each row alone that the test finds with the power wanted; infinite where
// nothing checks the row.
Eigen::VectorXd minimal_detectable(const RowsTest& test, double noncentrality);

// A term beside what the adjustment made of it.
class TermReliability {
 public:
  TermReliability(const Term& term, const NetworkCovariance& covariance);

  // Of rows [first, first + count), which were part of the adjustment.
  RowsTest test(int first, int count) const;
  // The same for rows that were no part of it, though they are of `term`.
  RowsTest test_outside(int first, int count) const;
  // Columns of the reduced system by an error of the rows: the pull of the term, columns x count.
  Eigen::MatrixXd influence(int first, int count) const;
  // What a linear function of the columns (weights: columns x k) would have as additional
  // covariance (k x k) without the rows. Very large where they alone fix it.
  Eigen::MatrixXd lost_without(int first, int count, const Eigen::MatrixXd& covariance_with) const;

 private:
  const Term& term_;
  Eigen::MatrixXd adjusted_;  // covariance of the computed values, A C A'
  Eigen::MatrixXd spread_;    // P - P A C A' P: covariance of P times the residuals
  Eigen::VectorXd weighted_;  // P times the residuals
};

}  // namespace plumbline::orient
