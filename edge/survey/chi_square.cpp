// SPDX-License-Identifier: MIT
#include "edge/survey/chi_square.h"

#include <cmath>
#include <limits>

namespace plumbline::survey {
namespace {

constexpr double kSmall = 1e-15;

// x^a exp(-x) / Gamma(a), common to the series and to the fraction.
double front_factor(double a, double x) { return std::exp(a * std::log(x) - x - std::lgamma(a)); }

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

// Abramowitz and Stegun 6.5.31, evaluated from the front (W. J. Lentz 1976): for x >= a + 1.
double upper_by_fraction(double a, double x) {
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
  return fraction * front_factor(a, x);
}

}  // namespace

double chi_square_share_below(double value, int dof) {
  if (!(value > 0.0) || dof <= 0) return 0.0;
  const double a = 0.5 * dof;
  const double x = 0.5 * value;
  return x < a + 1.0 ? lower_by_series(a, x) : 1.0 - upper_by_fraction(a, x);
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

}  // namespace plumbline::survey
