// SPDX-License-Identifier: MIT
#pragma once

namespace plumbline::survey {

// The share of a chi-square variable with `dof` degrees of freedom that lies below `value`:
// the regularised lower incomplete gamma function P(dof / 2, value / 2).
// Source: Abramowitz and Stegun 26.4.19; to 1e-12. dof > 0; 0 where value <= 0.
double chi_square_share_below(double value, int dof);

// The value below which `share` of a chi-square variable lies: the inverse of the above, to 1e-9
// relative. share in (0, 1).
double chi_square_quantile(double share, int dof);

}  // namespace plumbline::survey
