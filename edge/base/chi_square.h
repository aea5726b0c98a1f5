// SPDX-License-Identifier: MIT
#pragma once

namespace plumbline {

// The share of a chi-square variable with `dof` degrees of freedom that lies below `value`:
// the regularised lower incomplete gamma function P(dof / 2, value / 2).
// Source: Abramowitz and Stegun 26.4.19; to 1e-12. dof > 0; 0 where value <= 0.
double chi_square_share_below(double value, int dof);

// The value below which `share` of a chi-square variable lies: the inverse of the above, to 1e-9
// relative. share in (0, 1).
double chi_square_quantile(double share, int dof);

// The same share of a non-central chi-square variable: a sum of central ones weighted by Poisson
// (Abramowitz and Stegun 26.4.25); to 1e-10 for noncentrality up to 1000.
double noncentral_chi_square_share_below(double value, int dof, double noncentrality);

// The non-centrality at which a chi-square test with `dof` degrees of freedom, of critical value
// `critical`, fires with probability `power` (Baarda 1968, lambda_0), to 1e-9 relative. `power` in
// (the probability of a false alarm, 1).
double noncentrality_for_power(double critical, int dof, double power);

// The natural logarithm of the share above `value`: compares tests of different degrees of freedom
// far beyond where shares round to 0.
double chi_square_log_share_above(double value, int dof);

}  // namespace plumbline
