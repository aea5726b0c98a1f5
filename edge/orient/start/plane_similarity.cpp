// SPDX-License-Identifier: MIT
#include "edge/orient/start/plane_similarity.h"

#include <algorithm>
#include <random>

namespace plumbline::orient {
namespace {

constexpr int kSamples = 300;

// Written out in real numbers: the product of complex ones looks for infinities.
bool agrees(const PlaneMatch& match, const PlaneSimilarity& s, double tolerance) {
  const double ar = s.a.real(), ai = s.a.imag(), x = match.first.real(), y = match.first.imag();
  const double re = ar * x - ai * y + s.b.real() - match.second.real();
  const double im = ar * y + ai * x + s.b.imag() - match.second.imag();
  return re * re + im * im <= tolerance * tolerance;
}

std::vector<bool> agreeing(const std::vector<PlaneMatch>& matches, const PlaneSimilarity& s,
                           double tolerance) {
  std::vector<bool> agree(matches.size());
  for (std::size_t i = 0; i < matches.size(); ++i) agree[i] = agrees(matches[i], s, tolerance);
  return agree;
}

// How many matches agree; any number up to `enough` where they are no more than that.
int count_beyond(int enough, const std::vector<PlaneMatch>& matches, const PlaneSimilarity& s,
                 double tolerance) {
  int count = 0;
  int left = static_cast<int>(matches.size());
  for (const PlaneMatch& match : matches) {
    count += agrees(match, s, tolerance) ? 1 : 0;
    if (count + --left <= enough) break;
  }
  return count;
}

PlaneSimilarity through(const PlaneMatch& p, const PlaneMatch& q) {
  const std::complex<double> a = (q.second - p.second) / (q.first - p.first);
  return {a, p.second - a * p.first, 0};
}

// Linear least squares over the complex numbers: a = <first', second'> / <first', first'>.
PlaneSimilarity refined(const std::vector<PlaneMatch>& matches, const std::vector<bool>& chosen) {
  std::complex<double> mean_first = 0, mean_second = 0;
  int count = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!chosen[i]) continue;
    mean_first += matches[i].first;
    mean_second += matches[i].second;
    ++count;
  }
  mean_first /= count;
  mean_second /= count;
  std::complex<double> cross = 0;
  double square = 0;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!chosen[i]) continue;
    cross += std::conj(matches[i].first - mean_first) * (matches[i].second - mean_second);
    square += std::norm(matches[i].first - mean_first);
  }
  const std::complex<double> a = square > 0 ? cross / square : 1.0;
  return {a, mean_second - a * mean_first, count};
}

int count_of(const std::vector<bool>& chosen) {
  return static_cast<int>(std::count(chosen.begin(), chosen.end(), true));
}

}  // namespace

std::optional<PlaneSimilarity> fit_similarity(const std::vector<PlaneMatch>& matches,
                                              double tolerance) {
  if (matches.size() < static_cast<std::size_t>(kLeastMatches)) return std::nullopt;
  std::mt19937_64 random(20181);
  PlaneSimilarity chosen;
  int most = 0;
  for (int sample = 0; sample < kSamples && most < static_cast<int>(matches.size()); ++sample) {
    const PlaneMatch& p = matches[random() % matches.size()];
    const PlaneMatch& q = matches[random() % matches.size()];
    if (std::abs(q.first - p.first) < tolerance || std::abs(q.second - p.second) < tolerance) {
      continue;
    }
    const PlaneSimilarity candidate = through(p, q);
    const int count = count_beyond(most, matches, candidate, tolerance);
    if (count <= most) continue;
    most = count;
    chosen = candidate;
  }
  if (most < kLeastMatches) return std::nullopt;
  std::vector<bool> best = agreeing(matches, chosen, tolerance);
  best = agreeing(matches, refined(matches, best), tolerance);
  if (count_of(best) < kLeastMatches) return std::nullopt;
  return refined(matches, best);
}

}  // namespace plumbline::orient
