// SPDX-License-Identifier: MIT
#include <cmath>
#include <cstdio>

#include "edge/base/index.h"
#include "edge/plan/words.h"
#include "firmware/commands/plan_output.h"

namespace plumbline::commands {
namespace {

using plan::length_in_words;

template <typename... Arguments>
std::string text(const char* format, Arguments... arguments) {
  char buffer[512];
  std::snprintf(buffer, sizeof buffer, format, arguments...);
  return buffer;
}

std::string entry(const char* label, const std::string& value) {
  return text("  %-26s", label) + value + "\n";
}

std::string cell(std::optional<double> metres) {
  return text("%11s", length_in_words(metres).c_str());
}

std::string in_degrees(std::optional<double> degrees) {
  return degrees ? text("%.2g degrees", *degrees) : "unknown";
}

std::string percent(std::optional<double> share) {
  return share ? text("%.2g %%", 100 * *share) : "unknown";
}

// Wrapped at blanks to 98 columns; following lines are set in.
std::string wrapped(const std::string& sentence, const char* first) {
  constexpr std::size_t kWidth = 98;
  std::string out = first, indent(out.size(), ' ');
  std::size_t column = out.size();
  for (std::size_t begin = 0; begin < sentence.size();) {
    const std::size_t end = std::min(sentence.find(' ', begin), sentence.size());
    if (column > indent.size() && column + end - begin >= kWidth) {
      out += "\n" + indent;
      column = indent.size();
    } else if (column > indent.size()) {
      out += ' ';
    }
    out += sentence.substr(begin, end - begin);
    column += end - begin + 1;
    begin = end + 1;
  }
  return out + "\n";
}

std::string flight_lines(const plan::Summary& summary, const plan::Flight& flight) {
  double aside = 0;
  for (const auto& place : flight.all_m()) {
    aside = std::max(aside, (place.head<2>() - plan::foot_of(flight)).norm());
  }
  std::string out = text("%d photos from %.6g to %.6g m", summary.flight.photos,
                         plan::lowest_m(flight), plan::highest_m(flight));
  if (aside > 0.5) out += text(", up to %.3g m aside", aside);
  return "Plan: " + out + text(", about %.0f s in the air\n", summary.duration_s);
}

std::string assumed_lines(const plan::Options& options) {
  std::string known = text("image sigma %.3g px, %d ties", options.sigma_px, options.ties);
  known += options.rtk ? text(", RTK %.3g/%.3g mm", 1000 * options.rtk->sigma_horizontal_m,
                              1000 * options.rtk->sigma_vertical_m)
                       : ", no RTK (--rtk 0.005,0.010)";
  if (options.heading_sigma_deg) known += text(", heading %.3g deg", *options.heading_sigma_deg);
  if (options.known_length_m) known += text(", known length %.4g m", *options.known_length_m);
  if (options.control_points > 0) known += text(", %d control points", options.control_points);
  const std::string nature = text(
      "camera tilts of %.3g deg, wander of %.3g m about the line, ground relief of %.3g m (RMS)",
      options.tilt_deg, options.wander_m, options.relief_m);
  return entry("known", known) + entry("assumed", nature);
}

std::string ring_line(const plan::RingSigma& ring, bool georeferenced) {
  std::string out = text("  %5.4g to %-6.4g", ring.ring.from_m, ring.ring.to_m) +
                    cell(ring.sigma.local.plan_m) + cell(ring.sigma.local.height_m);
  if (georeferenced) out += cell(ring.sigma.absolute.plan_m) + cell(ring.sigma.absolute.height_m);
  return out + cell(ring.climb_formula_height_m) + "\n";
}

std::string ring_table(const plan::Prediction& prediction) {
  const bool absolute = prediction.georeferenced;
  std::string out =
      "\nSigma of one measured point, by distance from the foot of the climb (plan: each axis)\n";
  out += text("  %-15s%22s", "", "local");
  if (absolute) out += text("%22s", "absolute");
  out += text("%11s\n", "climb");
  out += text("  %-15s%11s%11s", "m", "plan", "height");
  if (absolute) out += text("%11s%11s", "plan", "height");
  out += text("%11s\n", "formula");
  for (const auto& ring : prediction.rings) out += ring_line(ring, absolute);
  out += text("  %-15s", "foot itself") + cell(prediction.foot.local.plan_m) +
         cell(prediction.foot.local.height_m);
  if (absolute)
    out += cell(prediction.foot.absolute.plan_m) + cell(prediction.foot.absolute.height_m);
  return out + "\n";
}

std::string common_lines(const plan::Summary& summary, const plan::Options& options) {
  const plan::Prediction& p = summary.flight;
  const double f = options.camera.interior[geometry::kFocalLength];
  std::string out =
      "\nThe whole\n" + entry("azimuth", in_degrees(p.azimuth_deg)) +
      entry("level", in_degrees(p.tilt_deg)) +
      entry("focal length",
            std::isfinite(p.focal_length_px)
                ? text("%.3g px (%.2g %%)", p.focal_length_px, 100 * p.focal_length_px / f)
                : "unknown") +
      entry("scale", percent(p.scale)) + entry("position", length_in_words(p.position_m));
  if (summary.standard_accuracy) {
    out += entry("standard accuracy (eq. 6)",
                 text("plan %s, height %s: H %.4g m, B %.4g m, %.3g px, photos side by side",
                      length_in_words(summary.standard_accuracy->plan_m).c_str(),
                      length_in_words(summary.standard_accuracy->height_m).c_str(),
                      summary.mean_height_m, summary.base_m, options.sigma_px));
  }
  return out;
}

std::string unobservable_lines(const plan::Prediction& prediction) {
  if (prediction.unobservable.empty()) return "\nNothing is unobservable.\n";
  std::string out = "\nNot observable\n";
  for (const auto& item : prediction.unobservable) out += wrapped(item.sentence, "  - ");
  return out;
}

std::string advice_lines(const plan::Summary& summary, const plan::Options& options) {
  std::string out = text("\nWhat could be changed, by cost\n  %7s%11s%11s%12s\n", "cost", "plan",
                         "height", "azimuth");
  for (std::size_t i = 0; i < summary.advice.size(); ++i) {
    const plan::Advice& advice = summary.advice[i];
    const std::string azimuth =
        advice.azimuth_deg ? text("%.2g deg", *advice.azimuth_deg) : "unknown";
    const bool chosen =
        summary.cheapest == static_cast<int>(i) || summary.best == static_cast<int>(i);
    const bool reaches = options.goal_m && advice.reaches_goal;
    out += text("%c %5.0f s", chosen ? '>' : ' ', advice.change.cost_s) +
           cell(advice.worst.plan_m) + cell(advice.worst.height_m) + text("%12s", azimuth.c_str()) +
           (reaches ? " * " : "   ") + advice.change.what + "\n";
  }
  if (options.goal_m) out += "  * reaches the goal\n";
  return out;
}

}  // namespace

std::string plan_table(const plan::Summary& summary, const plan::Flight& flight,
                       const plan::Options& options) {
  return flight_lines(summary, flight) + assumed_lines(options) + ring_table(summary.flight) +
         common_lines(summary, options) + unobservable_lines(summary.flight) +
         advice_lines(summary, options) + "\n" + wrapped(summary.sentence, "");
}

}  // namespace plumbline::commands
