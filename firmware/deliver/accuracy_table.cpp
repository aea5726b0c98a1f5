// SPDX-License-Identifier: MIT
#include <algorithm>

#include "firmware/deliver/reliance.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/table.h"
#include "firmware/deliver/text.h"
#include "firmware/deliver/verdict.h"

namespace plumbline::deliver {
namespace {

std::string padded(const std::string& text, std::size_t width, bool right) {
  const std::string blanks(width > text.size() ? width - text.size() : 0, ' ');
  return right ? blanks + text : text + blanks;
}

std::string entry(const std::string& label, const std::string& value) {
  return "  " + padded(label, 26, false) + value + "\n";
}

std::string axes_line(const std::string& label, const Eigen::Vector3d& value_m) {
  std::string line = "  " + padded(label, 40, false);
  for (int axis = 0; axis < 3; ++axis)
    line += padded(fixed_or(value_m[axis], 4, "unknown"), 12, true);
  return line + "\n";
}

// Wrapped at blanks to 98 columns; following lines are set in.
std::string wrapped(const std::string& sentence) {
  std::string text = "  - ";
  std::size_t column = 4;
  std::size_t at = 0;
  while (at < sentence.size()) {
    const std::size_t end = std::min(sentence.find(' ', at), sentence.size());
    if (column > 4 && column + end - at > 98) {
      text += "\n    ";
      column = 4;
    } else if (column > 4) {
      text += ' ';
    }
    text += sentence.substr(at, end - at);
    column += end - at + 1;
    at = end + 1;
  }
  return text + "\n";
}

std::string listed(const std::string& heading, const std::vector<std::string>& sentences) {
  if (sentences.empty()) return {};
  std::string text = "\n" + heading + "\n";
  for (const std::string& sentence : sentences) text += wrapped(clean_utf8(sentence));
  return text;
}

std::string adjustment_lines(const Product& product) {
  const orient::Summary& summary = product.solution.summary;
  const survey::Counts& counts = product.counts;
  std::string text = entry("photos used", std::to_string(counts.photos_used) + " of " +
                                              std::to_string(counts.photos_given));
  text += entry("tie points", std::to_string(counts.tie_points) + " (" +
                                  std::to_string(counts.tie_points_3plus) +
                                  " in three photos or more)");
  text += entry("adjustment", std::string(summary.converged ? "converged" : "NOT CONVERGED") +
                                  " in " + counted(summary.iterations, "iteration", "iterations") +
                                  ", redundancy " + std::to_string(summary.redundancy) + ", " +
                                  std::to_string(summary.observations_rejected) + " rejected");
  text += entry("sigma0", fixed_or(summary.sigma0, 3, "unknown"));
  text += entry("image sigma", fixed_or(summary.image_sigma_px, 3, "unknown") + " px");
  text += entry("reprojection RMS", fixed_or(summary.reprojection_rms_px, 3, "unknown") + " px");
  text += entry("flying height", fixed_or(summary.flying_height_m, 1, "unknown") + " m");
  return text;
}

std::string sigma_lines(const Product& product, const std::vector<int>& points,
                        const std::string& kind) {
  const auto figures = sigma_figures(product, points);
  if (!figures) return {};
  const std::string whose = counted(static_cast<long long>(points.size()), kind, kind + "s");
  std::string text = axes_line(whose + ", median sigma", figures->median);
  text += axes_line(whose + ", largest sigma", figures->largest);
  if (const auto local = local_sigma_figures(product, points))
    text += axes_line(whose + ", median of shape alone", local->median);
  return text;
}

std::string check_lines(const survey::CheckReport& check) {
  const std::string whose =
      counted(static_cast<long long>(check.points.size()), "check point", "check points");
  std::string text = axes_line(whose + ", RMSE", check.rmse_m);
  text += axes_line(whose + ", RMS stated sigma", check.rms_stated_sigma_m);
  if (check.best_fit_rmse_m)
    text += axes_line(whose + ", RMSE after best fit", *check.best_fit_rmse_m);
  return text;
}

std::string derived_lines(const std::vector<DerivedFigure>& figures) {
  std::string text;
  for (const DerivedFigure& figure : figures) {
    std::string label = figure.kind;
    for (const std::string& point : figure.points) label += ' ' + clean_utf8(point);
    if (figure.level_m) label += " above " + fixed(*figure.level_m, 3) + " m";
    text += "  " + padded(label, 40, false);
    text += figure.value
                ? padded(fixed_or(figure.value->value, 4, "unknown"), 12, true) + " " +
                      figure.unit + ", sigma " + fixed_or(figure.value->sigma, 4, "unknown") + "\n"
                : "     unknown: nothing in the input gives the scale\n";
  }
  return text;
}

std::vector<std::string> unobservable_sentences(const Product& product) {
  std::vector<std::string> sentences;
  for (const orient::Unobservable& item : product.solution.summary.unobservable)
    sentences.push_back(item.name + ": " + item.sentence);
  return sentences;
}

}  // namespace

std::string accuracy_table(const Product& product) {
  const PointKinds kinds = point_kinds(product);
  std::string text = verdict(product).headline + "\n\n" + adjustment_lines(product);
  text += "\n  " + padded("metres, one standard deviation", 40, false) + padded("east", 12, true) +
          padded("north", 12, true) + padded("up", 12, true) + "\n";
  text += sigma_lines(product, kinds.named, "named point");
  text += sigma_lines(product, kinds.ties, "tie point");
  if (product.check) {
    text += check_lines(*product.check);
    text += listed("At the check points", check_sentences(*product.check));
  }
  text += derived_lines(product.derived);
  text += listed("Not observable", unobservable_sentences(product));
  text += listed("Relative only", relative_only(product));
  text += listed("Warnings", all_warnings(product));
  return text;
}

}  // namespace plumbline::deliver
