// SPDX-License-Identifier: MIT
#include "edge/base/chi_square.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline {
namespace {

constexpr double kSmall = 1e-15;

// x^a exp(-x) / Gamma(a), common to the series and to the fraction.
double log_front_factor(double a, double x) { return a * std::log(x) - x - std::lgamma(a); }
double front_factor(double a, double x) { return std::exp(log_front_factor(a, x)); }

// Abramowitz and Stegun 6.5.29: converges fast for x < a + 1.
double lower_by_series(double a, double x) {
  double term = 1.0 / a;
  double sum = term;
  for (double k = a + 1.0; std::abs(term) > kSmall * std::abs(sum); k += 1.0) {
    term *= x / k;
    sum += term;
  }
  return sum * front_factor(a, x);
}

// Abramowitz and Stegun 6.5.31, without the factor in front, evaluated from
// the front (W. J. Lentz 1976): for x >= a + 1.
double upper_fraction(double a, double x) {
  constexpr double kTiny = std::numeric_limits<double>::min() / kSmall;
  double b = x + 1.0 - a;
  double c = 1.0 / kTiny;
  double d = 1.0 / b;
  double fraction = d;
  for (int i = 1; i < 100000; ++i) {
    const double numerator = -i * (i - a);
    b += 2.0;
    d = numerator * d + b;
    if (std::abs(d) < kTiny) d = kTiny;
    c = b + numerator / c;
    if (std::abs(c) < kTiny) c = kTiny;
    d = 1.0 / d;
    fraction *= d * c;
    if (std::abs(d * c - 1.0) < kSmall) break;
  }
  return fraction;
}

}  // namespace

double chi_square_share_below(double value, int dof) {
  if (!(value > 0.0) || dof <= 0) return 0.0;
  const double a = 0.5 * dof;
  const double x = 0.5 * value;
  return x < a + 1.0 ? lower_by_series(a, x) : 1.0 - upper_fraction(a, x) * front_factor(a, x);
}

double chi_square_quantile(double share, int dof) {
  double low = 0.0;
  double high = dof + 10.0;
  while (chi_square_share_below(high, dof) < share) high *= 2.0;
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (chi_square_share_below(middle, dof) < share ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double noncentral_chi_square_share_below(double value, int dof, double noncentrality) {
  const double half = 0.5 * noncentrality;
  // Poisson weights beyond ten standard deviations do not count.
  const double reach = 10 * std::sqrt(half) + 25;
  const int first = static_cast<int>(std::max(0.0, half - reach));
  const int last = static_cast<int>(half + reach);
  double sum = 0;
  for (int j = first; j <= last; ++j) {
    const double log_weight =
        (half > 0 ? j * std::log(half) : (j == 0 ? 0.0 : -1e9)) - half - std::lgamma(j + 1.0);
    sum += std::exp(log_weight) * chi_square_share_below(value, dof + 2 * j);
  }
  return sum;
}

double noncentrality_for_power(double critical, int dof, double power) {
  double low = 0, high = critical + 10;
  const auto missed = [&](double lambda) {
    return noncentral_chi_square_share_below(critical, dof, lambda);
  };
  while (missed(high) > 1 - power) high *= 2;
  while (high - low > 1e-10 * high) {
    const double middle = 0.5 * (low + high);
    (missed(middle) > 1 - power ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

double chi_square_log_share_above(double value, int dof) {
  if (!(value > 0.0)) return 0.0;
  const double a = 0.5 * dof, x = 0.5 * value;
  if (x < a + 1.0) return std::log1p(-chi_square_share_below(value, dof));
  return std::log(upper_fraction(a, x)) + log_front_factor(a, x);
}

}  // namespace plumbline
