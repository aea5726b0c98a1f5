// SPDX-License-Identifier: MIT
#include "edge/orient/findings/findings.h"

#include <algorithm>
#include <cmath>

#include "edge/base/units.h"
#include "edge/orient/findings/exchanged_names.h"
#include "edge/orient/findings/formatted.h"
#include "edge/orient/findings/no_solution.h"

namespace plumbline::orient {
namespace {

// A quantity rests on a claim alone where the claim takes all but this share of its variance away,
// and mostly on it where an error that the tests may miss moves it by so many of its sigmas (Baarda
// 1968, external reliability).
constexpr double kCarriedByOthers = 0.02;
constexpr double kMovedUnseen = 10;
constexpr double kTellingSigmas = 3;  // below, a size in sigmas would speak against itself
constexpr double kStrangeGroup = 3;   // sigma0 of headings or attitudes

std::string capital(std::string sentence) {
  if (!sentence.empty() && sentence[0] >= 'a' && sentence[0] <= 'z')
    sentence[0] = static_cast<char>(sentence[0] - 'a' + 'A');
  return sentence;
}

const char* kind_of(const Claim& claim) {
  switch (claim.kind) {
    case ClaimKind::kStation:
      return "station";
    case ClaimKind::kLength:
      return "length";
    case ClaimKind::kControl:
      return "control";
    case ClaimKind::kInterior:
      break;
  }
  return claim.index == geometry::kFocalLength ? "focal_length" : "interior";
}

std::string subject_of(const Claim& claim, const Network& network) {
  const std::string words = in_words(claim, network);
  for (const std::string start : {"the GNSS position of photo ", "the known length from ",
                                  "the control point ", "the calibrated "}) {
    if (words.starts_with(start)) return words.substr(start.size());
  }
  return words;
}

// NaN where nothing tells it.
double size_of(const ClaimTest& test, const Finished& f) {
  if (test.claim.kind == ClaimKind::kInterior)
    return f.network.problem->camera.interior[test.claim.index] -
           f.state.interior[test.claim.index];
  if (test.rows.dof == 0) return std::nan("");
  return test.rows.gross_error.size() == 1 ? test.rows.gross_error[0]
                                           : test.rows.gross_error.norm();
}

// Set aside by what all together said, a claim may be the last to know some quantity well: what is
// left can then not tell that it is wrong, or by how much.
bool left_untold(const ClaimTest& test) {
  return test.rows.dof == 0 || std::sqrt(test.rows.statistic) < kTellingSigmas;
}

std::string sentence_without_size(const Claim& claim, const Finished& f) {
  const std::string what = capital(in_words(claim, f.network));
  if (claim.kind != ClaimKind::kInterior)
    return what +
           " contradicts all the rest and was not used; without it the rest is too weak to tell by "
           "how much it is off.";
  const double found = f.state.interior[claim.index];
  const double sigma = std::sqrt(std::max(0.0, f.covariance.common()(claim.index, claim.index)));
  return what + formatted(
                    " (%.1f px) contradicts photos and positions and was not used. Without it they "
                    "ask for %.1f px, known to %.2g %% (sigma) only: check the camera file, its "
                    "distortion too.",
                    f.network.problem->camera.interior[claim.index], found, 100 * sigma / found);
}

std::string sentence_of(const ClaimTest& test, double size, const Finished& f) {
  const double sigmas = std::sqrt(test.rows.statistic);
  const std::string what = capital(in_words(test.claim, f.network));
  if (left_untold(test)) return sentence_without_size(test.claim, f);
  switch (test.claim.kind) {
    case ClaimKind::kStation:
      return what + formatted(" disagrees with all others by %.2f m (%.1f sigma) and was not used.",
                              size, sigmas);
    case ClaimKind::kLength:
      return what + formatted(" is %.3f m too %s by all the rest (%.1f sigma) and was not used.",
                              std::abs(size), size > 0 ? "long" : "short", sigmas);
    case ClaimKind::kControl:
      return what + formatted(" is off by %.3f m by all the rest (%.1f sigma) and was not used.",
                              size, sigmas);
    case ClaimKind::kInterior:
      break;
  }
  const double given = f.network.problem->camera.interior[test.claim.index];
  if (test.claim.index == geometry::kFocalLength)
    return what + formatted(
                      " (%.1f px) is off by %.2g %% (%.1f sigma): photos and positions ask for "
                      "%.1f px, which was used.",
                      given, 100 * std::abs(size) / f.state.interior[0], sigmas,
                      f.state.interior[0]);
  return what + formatted(" (%.4g) is contradicted by the photos (%.1f sigma): %.4g was used.",
                          given, sigmas, f.state.interior[test.claim.index]);
}

void add_blunder(const ClaimTest& test, const Finished& f, Solution& solution) {
  const Claim& claim = test.claim;
  Blunder blunder;
  blunder.kind = kind_of(claim);
  blunder.subject = subject_of(claim, f.network);
  blunder.size = size_of(test, f);
  blunder.statistic = test.rows.statistic;
  blunder.critical = test.threshold.critical;
  blunder.sentence = sentence_of(test, blunder.size, f);
  solution.summary.warnings.push_back(blunder.sentence);
  solution.summary.blunders.push_back(std::move(blunder));
}

StationCheck station_check(const ClaimTest& test) {
  StationCheck check;
  check.directions = test.rows.dof;
  check.statistic = test.rows.statistic;
  check.critical = test.threshold.critical;
  check.noncentrality = test.threshold.noncentrality;
  check.detectability = test.rows.detectability;
  check.redundancy = test.rows.redundancy;
  check.minimal_detectable_m = minimal_detectable(test.rows, check.noncentrality);
  return check;
}

void check_stations(const std::vector<ClaimTest>& tests, const Finished& f, Solution& solution) {
  for (const ClaimTest& test : tests) {
    if (test.claim.kind != ClaimKind::kStation || test.rows.redundancy.size() == 0) continue;
    const int photo = f.network.photo_of_slot[at(test.claim.index)];
    solution.photos[at(photo)].station_check = station_check(test);
  }
}

// What is common to the whole, and one figure each for what it would be without a claim.
struct Quantity {
  const char* name;
  const char* words;
  const char* unit;
  double factor;
  double variance;  // as adjusted
  int place;        // of the similarity (0 to 6), 7 = focal length
};

std::vector<Quantity> quantities(const Finished& f, const LocalFrameFit& frame) {
  const DatumDefect defect = datum_defect(f.network, f.terms);
  const auto& c = frame.common_covariance;
  std::vector<Quantity> out;
  if (!defect.azimuth) out.push_back({"azimuth", "azimuth", "degrees", kDegPerRad, c(5, 5), 5});
  if (!defect.scale) out.push_back({"scale", "scale", "%", 100, c(6, 6), 6});
  if (!defect.translation) {
    const int plan = c(0, 0) > c(1, 1) ? 0 : 1;
    out.push_back({"position", "position in plan", "m", 1, c(plan, plan), plan});
    out.push_back({"position_height", "height of the whole", "m", 1, c(2, 2), 2});
  }
  const int tilt = c(3, 3) > c(4, 4) ? 3 : 4;
  out.push_back({"tilt", "level", "degrees", kDegPerRad, c(tilt, tilt), tilt});
  const double variance = f.covariance.common()(0, 0);
  out.push_back({"focal_length", "focal length", "px", 1, variance, 7});
  return out;
}

std::string figure(double value, const Quantity& q) {
  return two_digits(value * q.factor) + " " + q.unit;
}

std::string motion_in_words(double value, const Quantity& q) {
  const bool full_turn = q.factor == kDegPerRad && value * q.factor > 180;
  return full_turn ? "any angle" : figure(value, q);
}

// `unseen`: by how much an error of the claim may move it before a test finds that.
std::string sentence_of(const Quantity& q, const std::string& subject, double without,
                        double unseen) {
  const double known = std::sqrt(std::max(0.0, q.variance));
  if (q.variance > kCarriedByOthers * without * without) {
    return std::string("The ") + q.words + " (sigma " + figure(known, q) + ") rests mostly on " +
           subject + ": an error there may move it by " + motion_in_words(unseen, q) +
           " before a test finds it; without it the " + q.words + " would be known to " +
           figure(without, q) + " only.";
  }
  const bool nothing = !(without < 1e3 * std::max(known, 1e-6));
  return std::string("The ") + q.words + " (sigma " + figure(known, q) + ") rests on " + subject +
         " alone: nothing checks it. Were that wrong, no residual would show it; without it the " +
         q.words +
         (nothing ? " would not be known." : " would be known to " + figure(without, q) + " only.");
}

// The variance of each quantity that is lost without a claim.
Eigen::VectorXd lost(const Claim& claim, const Finished& f, const Eigen::MatrixXd& with_columns) {
  const ClaimRows rows = rows_of(claim, f.network, f.terms, f.linear);
  const TermReliability reliability(f.linear[at(rows.term)], f.covariance);
  return reliability.lost_without(rows.first, rows.count, with_columns).diagonal();
}

void add_unchecked(const std::vector<ClaimTest>& believed, const Finished& f,
                   const LocalFrameFit& frame, Solution& solution) {
  if (!frame.determined) return;
  Eigen::MatrixXd with_columns(f.network.layout.columns(), 8);
  with_columns << frame.with_columns, f.covariance.common().col(geometry::kFocalLength);
  const auto all = quantities(f, frame);
  for (const ClaimTest& test : believed) {
    const Claim& claim = test.claim;
    // What rests on the calibration is said where the focal length is judged.
    if (claim.kind == ClaimKind::kInterior) continue;
    const Eigen::VectorXd gone = lost(claim, f, with_columns);
    for (const Quantity& q : all) {
      const double unseen = std::sqrt(test.threshold.noncentrality * gone[q.place]);
      const bool alone = q.variance <= kCarriedByOthers * (q.variance + gone[q.place]);
      const bool mostly = claim.kind == ClaimKind::kStation &&
                          unseen > kMovedUnseen * std::sqrt(std::max(0.0, q.variance));
      if (!(q.variance > 0) || !(alone || mostly)) continue;
      const std::string subject = in_words(claim, f.network);
      Unchecked item{q.name, subject_of(claim, f.network),
                     sentence_of(q, subject, std::sqrt(q.variance + gone[q.place]), unseen)};
      solution.summary.warnings.push_back(item.sentence);
      solution.summary.unchecked.push_back(std::move(item));
    }
  }
}

// What is contradicted and yet stands, since too few others stand against it.
void add_contradictions(const std::vector<ClaimTest>& believed, const Finished& f,
                        Solution& solution) {
  const bool contradicted = std::any_of(believed.begin(), believed.end(), [](const ClaimTest& t) {
    return t.claim.kind == ClaimKind::kStation && t.fails();
  });
  if (!contradicted) return;
  solution.summary.warnings.push_back(
      "The GNSS positions of the " + std::to_string(station_slots(f.network, f.terms).size()) +
      " photos contradict each other or the photos, and are too few to tell which is wrong: check "
      "them, or fly again with more photos.");
}

bool has_station(const std::vector<ClaimTest>& tests) {
  return std::any_of(tests.begin(), tests.end(),
                     [](const ClaimTest& test) { return test.claim.kind == ClaimKind::kStation; });
}

// From above one place plan and focal length grow together: a focal length that is far off may be
// believed against the one station that tells.
void add_doubt_of_focal_length(const std::vector<ClaimTest>& rejected, Solution& solution) {
  const auto& unobservable = solution.summary.unobservable;
  const bool untested = std::any_of(unobservable.begin(), unobservable.end(),
                                    [](const Unobservable& u) { return u.name == "focal_length"; });
  if (!untested || !has_station(rejected)) return;
  solution.summary.warnings.emplace_back(
      "A GNSS position was not used, and the focal length was believed, which nothing else tests. "
      "If it is wrong, the position may be right, and all distances are off by as much: check the "
      "camera file, and try once with focal_length_px = \"free\" under [sigma].");
}

// Headings and attitudes are no claims that are tested. Where a station was found to be wrong
// beside them, they may be what is.
void add_doubt_of_headings(const std::vector<ClaimTest>& rejected, const Finished& f,
                           Solution& solution) {
  const bool station = has_station(rejected);
  const auto& photos = f.network.problem->photos;
  const bool told = std::any_of(photos.begin(), photos.end(), [](const Photo& photo) {
    return photo.heading.has_value() || photo.attitude.has_value();
  });
  if (!station || !told) return;
  solution.summary.warnings.emplace_back(
      "A GNSS position was not used, and the headings or attitudes given were believed. If those "
      "are wrong, it may be right: try once without them.");
}

// What a group of observations says of itself: far from 1, and it contradicts all the rest.
void add_strange_groups(const Problem& problem, Solution& solution) {
  const bool attitudes = std::any_of(problem.photos.begin(), problem.photos.end(),
                                     [](const Photo& p) { return p.attitude.has_value(); });
  for (const auto& [name, sigma0] : solution.summary.sigma0_by_group) {
    const bool is_given = name == "heading" || (name == "attitude" && attitudes);
    if (!is_given || sigma0 < kStrangeGroup) continue;
    solution.summary.warnings.push_back(
        "The " + std::string(name == "heading" ? "headings" : "attitudes") +
        " given contradict the photos" +
        formatted(" (residuals %.1f times their sigmas): one of them, or their sigmas, are wrong.",
                  sigma0));
  }
}

void add_minority(const Network& network, Solution& solution) {
  const Agreement found = agreement(network);
  if (!found.is_minority()) return;
  solution.summary.warnings.push_back(
      std::to_string(found.rays - found.used) + " of " + std::to_string(found.rays) +
      " image measurements contradict the rest and were not used: what a minority agrees on may be "
      "wrong as a whole. Check the camera, the names of points and the positions.");
}

}  // namespace

void add_findings(const Finished& f, const LocalFrameFit& straight, Solution& solution) {
  const auto believed = test_claims(f.network, f.terms, f.linear, f.covariance);
  const double family = family_size(believed, f.terms);
  std::vector<ClaimTest> rejected;
  for (const Claim& claim : f.rejected)
    rejected.push_back(
        test_rejected(claim, f.network, f.state, f.start, f.terms, f.covariance, family));
  for (const ClaimTest& test : rejected) add_blunder(test, f, solution);
  for (Blunder& blunder : exchanged_names(f)) {
    solution.summary.warnings.push_back(blunder.sentence);
    solution.summary.blunders.push_back(std::move(blunder));
  }
  check_stations(believed, f, solution);
  check_stations(rejected, f, solution);
  add_unchecked(believed, f, straight, solution);
  add_doubt_of_headings(rejected, f, solution);
  add_doubt_of_focal_length(rejected, solution);
  add_contradictions(believed, f, solution);
  add_strange_groups(*f.network.problem, solution);
  add_minority(f.network, solution);
}

}  // namespace plumbline::orient
