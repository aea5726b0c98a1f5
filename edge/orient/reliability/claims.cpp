// SPDX-License-Identifier: MIT
#include "edge/orient/reliability/claims.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace plumbline::orient {
namespace {

constexpr const char* kInteriorNames[geometry::kInteriorCount] = {"focal length",
                                                                  "principal point (u)",
                                                                  "principal point (v)",
                                                                  "affinity",
                                                                  "skew",
                                                                  "radial distortion k1",
                                                                  "radial distortion k2",
                                                                  "radial distortion k3",
                                                                  "tangential distortion p1",
                                                                  "tangential distortion p2"};

const char* group_of(ClaimKind kind) {
  switch (kind) {
    case ClaimKind::kStation:
      return "gnss";
    case ClaimKind::kLength:
      return "lengths";
    case ClaimKind::kControl:
      return "control";
    case ClaimKind::kInterior:
      break;
  }
  return "camera";
}

bool calibrated(const Network& network, int parameter) {
  const geometry::Camera& camera = network.problem->camera;
  const double sigma =
      camera.covariance ? (*camera.covariance)(parameter, parameter) : camera.sigma[parameter];
  return sigma > 0 && std::isfinite(sigma) && network.shared_mask[parameter] != 0;
}

// Without rays from two photos nothing checks where a known point is.
bool checked_by_rays(const Network& network, int point) { return used_rays(network, point) >= 2; }

void add_term_claims(const Term& term, const Network& network, const TermOptions& options,
                     std::vector<Claim>& out) {
  const Problem& problem = *network.problem;
  if (term.group == "gnss") {
    for (const int slot : station_slots(network, options))
      out.push_back({ClaimKind::kStation, slot});
  } else if (term.group == "lengths") {
    const Length& length = problem.lengths[at(term.subject)];
    if (checked_by_rays(network, length.point_a) && checked_by_rays(network, length.point_b))
      out.push_back({ClaimKind::kLength, term.subject});
  } else if (term.group == "control") {
    if (checked_by_rays(network, problem.control[at(term.subject)].point))
      out.push_back({ClaimKind::kControl, term.subject});
  } else if (term.group == "camera" && term.residual.size() == geometry::kInteriorCount) {
    for (int i = 0; i < geometry::kInteriorCount; ++i) {
      if (calibrated(network, i) && !options.interior_freed[at(i)])
        out.push_back({ClaimKind::kInterior, i});
    }
  }
}

// Without a claim that is checked so little, some quantity's sigma grows at least fivefold.
constexpr double kCarriedAlone = 0.04;
constexpr double kShareOfCarriers = 0.1;

double share_of(const RowsTest& rows) {
  if (rows.dof == 0) return 0;
  return rows.least_redundancy < kCarriedAlone ? kShareOfCarriers : 1;
}

std::string control_in_words(KnownBy known_by, const std::string& point) {
  switch (known_by) {
    case KnownBy::kFrameOrigin:
      return "point " + point + " (origin of the local frame)";
    case KnownBy::kFrameXAxis:
      return "point " + point + " (x axis of the local frame)";
    case KnownBy::kFramePlane:
      return "point " + point + " (plane of the local frame)";
    case KnownBy::kFlatGround:
      return "the flat ground declared at point " + point;
    case KnownBy::kSurvey:
      break;
  }
  return "the control point " + point;
}

// One set of products for all claims of a term.
class Reliabilities {
 public:
  Reliabilities(const Terms& terms, const NetworkCovariance& covariance)
      : terms_(terms), covariance_(covariance), made_(terms.size()) {}
  const TermReliability& of(int term) {
    auto& made = made_[at(term)];
    if (!made) made = std::make_unique<TermReliability>(terms_[at(term)], covariance_);
    return *made;
  }

 private:
  const Terms& terms_;
  const NetworkCovariance& covariance_;
  std::vector<std::unique_ptr<TermReliability>> made_;
};

void set_weight(std::vector<double>& weights, std::size_t count, int index, bool believed) {
  if (weights.empty()) weights.assign(count, 1.0);
  weights[at(index)] = believed ? 1 : 0;
}

}  // namespace

std::vector<Claim> believed_claims(const Network& network, const TermOptions& options,
                                   const Terms& terms) {
  std::vector<Claim> claims;
  for (const Term& term : terms) add_term_claims(term, network, options, claims);
  return claims;
}

ClaimRows rows_of(const Claim& claim, const Network& network, const TermOptions& options,
                  const Terms& terms) {
  for (int t = 0; t < static_cast<int>(terms.size()); ++t) {
    const Term& term = terms[at(t)];
    if (term.group != group_of(claim.kind)) continue;
    if (claim.kind == ClaimKind::kInterior) return {t, claim.index, 1};
    if (claim.kind == ClaimKind::kStation) {
      const auto slots = station_slots(network, options);
      const auto place = std::find(slots.begin(), slots.end(), claim.index);
      if (place == slots.end()) return {};
      return {t, 3 * static_cast<int>(place - slots.begin()), 3};
    }
    if (term.subject == claim.index) return {t, 0, static_cast<int>(term.residual.size())};
  }
  return {};
}

std::vector<ClaimTest> test_claims(const Network& network, const TermOptions& options,
                                   const Terms& terms, const NetworkCovariance& covariance) {
  std::vector<ClaimTest> tests;
  Reliabilities reliabilities(terms, covariance);
  for (const Claim& claim : believed_claims(network, options, terms)) {
    const ClaimRows rows = rows_of(claim, network, options, terms);
    tests.push_back({claim, reliabilities.of(rows.term).test(rows.first, rows.count), {}, true});
  }
  const double family = family_size(tests, options);
  for (ClaimTest& test : tests)
    test.threshold = threshold(test.rows.dof, share_of(test.rows) / family);
  return tests;
}

double family_size(const std::vector<ClaimTest>& believed, const TermOptions& options) {
  double size = 0;
  for (const ClaimTest& test : believed) size += share_of(test.rows);
  for (const auto* weights :
       {&options.station_weights, &options.length_weights, &options.control_weights})
    size += static_cast<double>(std::count(weights->begin(), weights->end(), 0.0));
  const auto& freed = options.interior_freed;
  return size + static_cast<double>(std::count(freed.begin(), freed.end(), true));
}

ClaimTest test_rejected(const Claim& claim, const Network& network, const State& state,
                        const State& start, const TermOptions& options,
                        const NetworkCovariance& covariance, double family) {
  TermOptions with = options;
  set_believed(claim, true, network, with);
  const Terms terms = linearised_terms(network, state, start, with);
  const ClaimRows rows = rows_of(claim, network, with, terms);
  ClaimTest test{claim, {}, {}, false};
  if (rows.term < 0) return test;
  test.rows =
      TermReliability(terms[at(rows.term)], covariance).test_outside(rows.first, rows.count);
  test.threshold = threshold(test.rows.dof, share_of(test.rows) / family);
  return test;
}

void set_believed(const Claim& claim, bool believed, const Network& network, TermOptions& options) {
  const Problem& problem = *network.problem;
  switch (claim.kind) {
    case ClaimKind::kStation:
      return set_weight(options.station_weights, at(network.slots()), claim.index, believed);
    case ClaimKind::kLength:
      return set_weight(options.length_weights, problem.lengths.size(), claim.index, believed);
    case ClaimKind::kControl:
      return set_weight(options.control_weights, problem.control.size(), claim.index, believed);
    case ClaimKind::kInterior:
      options.interior_freed[at(claim.index)] = !believed;
  }
}

std::string in_words(const Claim& claim, const Network& network) {
  const Problem& problem = *network.problem;
  const auto point = [&](int index) { return problem.point_names[at(index)]; };
  switch (claim.kind) {
    case ClaimKind::kStation:
      return "the GNSS position of photo " + network.photo(claim.index).name;
    case ClaimKind::kLength: {
      const Length& length = problem.lengths[at(claim.index)];
      return "the known length from " + point(length.point_a) + " to " + point(length.point_b);
    }
    case ClaimKind::kControl: {
      const Control& control = problem.control[at(claim.index)];
      return control_in_words(control.known_by, point(control.point));
    }
    case ClaimKind::kInterior:
      break;
  }
  return std::string("the calibrated ") + kInteriorNames[claim.index];
}

}  // namespace plumbline::orient
