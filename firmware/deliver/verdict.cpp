// SPDX-License-Identifier: MIT
#include "firmware/deliver/verdict.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "firmware/deliver/reliance.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"

namespace plumbline::deliver {
namespace {

std::string per_axis(const Eigen::Vector3d& value_m) {
  return fixed_or(value_m.x(), 3, "unknown") + " m east, " + fixed_or(value_m.y(), 3, "unknown") +
         " m north, " + fixed_or(value_m.z(), 3, "unknown") + " m up";
}

std::string percent(double share) { return fixed(100.0 * share, 0) + " %"; }

bool joint_test_passed(const survey::CheckReport& check) {
  return check.joint_nees_dof == 0 ||
         (check.joint_nees >= check.joint_nees_low && check.joint_nees <= check.joint_nees_high);
}

// Errors larger than stated are a fault; smaller ones only mean that the sigmas were cautious.
bool errors_larger_than_stated(const survey::CheckReport& check) {
  return check.same_frame && check.joint_nees_dof > 0 && check.joint_nees_holds &&
         check.joint_nees > check.joint_nees_high;
}

std::string joint_sentence(const survey::CheckReport& check) {
  const std::string figures =
      fixed(check.joint_nees, 1) + " for " + std::to_string(check.joint_nees_dof) +
      " degrees of freedom, 99 % interval " + fixed(check.joint_nees_low, 1) + " to " +
      fixed(check.joint_nees_high, 1);
  if (!check.joint_nees_holds)
    return "No joint test of the differences is made: azimuth or level of the whole are known so "
           "poorly that a turn within their sigma bends the errors off their bars.";
  if (joint_test_passed(check))
    return "Taken together the differences agree with the stated covariance (joint NEES " +
           figures + ").";
  if (check.joint_nees > check.joint_nees_high)
    return "Taken together the differences are LARGER than the stated covariance allows (joint "
           "NEES " +
           figures + "): the sigmas are too small.";
  return "Taken together the differences are smaller than the stated covariance lets expect "
         "(joint NEES " +
         figures + "): the sigmas are cautious.";
}

std::string position_class(double largest_m) {
  for (const double limit_m : std::array{0.05, 0.10, 0.20})
    if (largest_m <= limit_m)
      return "within the " + fixed(limit_m, 2) + " m position class (of 0.05, 0.10 and 0.20 m)";
  return "beyond the position classes of 0.05, 0.10 and 0.20 m";
}

std::string accuracy_sentence(const Product& product) {
  const PointKinds kinds = point_kinds(product);
  const bool by_name = !kinds.named.empty();
  const auto& points = by_name ? kinds.named : kinds.ties;
  const auto figures = sigma_figures(product, points);
  if (!figures) return "No point was measured.";
  return "Median standard deviation of " +
         counted(static_cast<long long>(points.size()), by_name ? "named point" : "tie point",
                 by_name ? "named points" : "tie points") +
         ": " + per_axis(figures->median) + ".";
}

// Said where the frame of the whole, not the shape, governs the sigmas.
std::string shape_sentence(const Product& product) {
  const PointKinds kinds = point_kinds(product);
  const auto& points = kinds.named.empty() ? kinds.ties : kinds.named;
  const auto all = sigma_figures(product, points);
  const auto shape = local_sigma_figures(product, points);
  if (!all || !shape || all->median.norm() < 2.0 * shape->median.norm()) return {};
  return "Of their shape alone, position, turn, tilt and scale of the whole set aside: " +
         per_axis(shape->median) + ".";
}

std::string check_sentence(const Product& product) {
  if (!product.check) return "No check points were given: the accuracy is predicted, not verified.";
  const survey::CheckReport& check = *product.check;
  if (!check.same_frame)
    return check.best_fit_rmse_m
               ? "RMSE of the shape at " + std::to_string(check.points.size()) +
                     " check points: " + per_axis(*check.best_fit_rmse_m) + "."
               : std::string("The check points are in another frame, and too few for a best fit.");
  std::string words =
      "RMSE at " +
      counted(static_cast<long long>(check.points.size()), "check point", "check points") + ": " +
      per_axis(check.rmse_m);
  if (check.best_fit_rmse_m) words += "; after a best fit " + per_axis(*check.best_fit_rmse_m);
  return words + ".";
}

std::string unobservable_names(const Product& product) {
  std::string names;
  for (const orient::Unobservable& item : product.solution.summary.unobservable) {
    std::string words = item.name;
    std::replace(words.begin(), words.end(), '_', ' ');
    names += (names.empty() ? "" : ", ") + words;
  }
  return names;
}

std::string headline(const Product& product, Verdict::Level& level) {
  const survey::Counts& counts = product.counts;
  const bool relative = !relative_only(product).empty();
  const std::string missing = unobservable_names(product);
  level = Verdict::Level::kBad;
  if (!product.solution.summary.converged)
    return "The adjustment did not converge: these figures must not be used.";
  if (product.check && errors_larger_than_stated(*product.check))
    return "Measured, but the errors at the check points are larger than the stated sigmas.";
  level = Verdict::Level::kCaution;
  if (!missing.empty()) return "Measured, but not everything was observable: " + missing + ".";
  if (relative) return "Measured; some figures hold only relative to each other.";
  if (counts.photos_used < counts.photos_given)
    return "Measured with " + std::to_string(counts.photos_used) + " of " +
           counted(counts.photos_given, "photo", "photos") + ".";
  level = Verdict::Level::kGood;
  if (product.check) return "Measured, and verified at independent check points.";
  return "Measured; the accuracy is predicted, not verified.";
}

// Heights that score no better than "everything is flat" are no measurement of relief.
std::string flat_sentence(const survey::CheckReport& check) {
  const bool beaten = check.rmse_m.z() < *check.flat_rmse_u_m;
  return "The flat answer, Z = 0 everywhere, would have scored " + fixed(*check.flat_rmse_u_m, 3) +
         " m in height; the measured heights score " + fixed(check.rmse_m.z(), 3) + " m" +
         (beaten ? "." : " and do not beat it.");
}

}  // namespace

Verdict verdict(const Product& product) {
  Verdict made;
  made.headline = headline(product, made.level);
  made.sentences = {accuracy_sentence(product)};
  if (const std::string shape = shape_sentence(product); !shape.empty())
    made.sentences.push_back(shape);
  made.sentences.push_back(check_sentence(product));
  return made;
}

std::vector<std::string> check_sentences(const survey::CheckReport& check) {
  std::vector<std::string> sentences;
  if (!check.same_frame)
    sentences.push_back(
        "Nothing ties the measurement to the frame of the check points: only the best fit, in "
        "which position, turn and scale are removed, means something.");
  if (check.same_frame) {
    sentences.push_back(percent(check.share_within_one_sigma) + " of the " +
                        std::to_string(3 * check.points.size()) +
                        " differences lie within one stated sigma (68 % expected), " +
                        percent(check.share_within_two_sigma) + " within two (95 % expected).");
    if (check.joint_nees_dof > 0) sentences.push_back(joint_sentence(check));
    sentences.push_back("The largest difference of any axis is " + fixed(check.largest_m, 3) +
                        " m: " + position_class(check.largest_m) + ".");
  }
  if (check.flat_rmse_u_m) sentences.push_back(flat_sentence(check));
  if (check.best_fit_rmse_m)
    sentences.push_back("After a best fit (7-parameter similarity) the shape agrees to " +
                        per_axis(*check.best_fit_rmse_m) + ".");
  for (const std::string& name : check.not_measured)
    sentences.push_back("Check point " + name + " was not measured.");
  for (const std::string& name : check.also_control)
    sentences.push_back("Check point " + name + " is also control, and was left out.");
  return sentences;
}

std::vector<std::string> all_warnings(const Product& product) {
  std::vector<std::string> warnings = product.solution.summary.warnings;
  warnings.insert(warnings.end(), product.warnings.begin(), product.warnings.end());
  return warnings;
}

}  // namespace plumbline::deliver
