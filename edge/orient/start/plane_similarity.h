// SPDX-License-Identifier: MIT
#pragma once

#include <complex>
#include <optional>
#include <vector>

namespace plumbline::orient {

// A point of the image plane as a complex number: x right, y up, in units of the focal length.
using PlanePoint = std::complex<double>;

struct PlaneMatch {
  PlanePoint first;
  PlanePoint second;
};

// second = a * first + b.
struct PlaneSimilarity {
  std::complex<double> a = 1;
  std::complex<double> b = 0;
  int inliers = 0;
};

// The similarity that most matches agree with to `tolerance` (in the second photo), refined over
// them by least squares. Empty with fewer than kLeastMatches agreeing. Deterministic.
inline constexpr int kLeastMatches = 4;
std::optional<PlaneSimilarity> fit_similarity(const std::vector<PlaneMatch>& matches,
                                              double tolerance);

}  // namespace plumbline::orient
