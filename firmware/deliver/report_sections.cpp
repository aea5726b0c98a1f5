// SPDX-License-Identifier: MIT
#include "firmware/deliver/report_sections.h"

#include <algorithm>
#include <cmath>

#include "edge/base/units.h"
#include "firmware/deliver/georeference.h"
#include "firmware/deliver/html.h"
#include "firmware/deliver/report_tables.h"
#include "firmware/deliver/statistics.h"
#include "firmware/deliver/text.h"
#include "firmware/deliver/verdict.h"

namespace plumbline::deliver {
namespace {

// A plumb line: the mark of the program.
constexpr const char* kMark =
    "<svg viewBox=\"0 0 30 62\" aria-hidden=\"true\"><path d=\"M4 2h22M15 2v32\" "
    "stroke=\"#1c2733\" stroke-width=\"2\" fill=\"none\"/><path d=\"M8 34h14l-1 9-6 17-6-17z\" "
    "fill=\"#c8500a\"/></svg>\n";

const std::string kDegree = "\xc2\xb0";

std::string frame_words(const Product& product) {
  if (const auto& roles = product.solution.frame) {
    const auto name = [&](int point) {
      return product.problem.point_names[static_cast<std::size_t>(point)];
    };
    return "Local frame of three points: origin " + name(roles->origin) + ", x axis to " +
           name(roles->x_axis) + ", x-y plane through " + name(roles->plane) +
           ". East, north and up stand for its X, Y and Z.";
  }
  if (!product.origin)
    return "Local frame only: x east, y north, z up as far as the positions of the photos say so; "
           "no place on the earth was given.";
  const GeoOrigin& origin = *product.origin;
  std::string words = "Local frame east, north, up at " + fixed(origin.latitude_deg, 8) + kDegree +
                      ", " + fixed(origin.longitude_deg, 8) + kDegree + ", ellipsoidal height " +
                      fixed(origin.height_ellipsoidal_m, 3) + " m. ";
  const auto earth = Georeference::of(product);
  const std::string grid = earth && *earth ? (*earth)->grid_in_words() : "";
  if (!grid.empty()) words += "Map: " + grid + ". ";
  return words + "Datum: " + product.datum + ".";
}

std::string card(const std::string& name, const std::string& value, const std::string& more) {
  return element("div",
                 element("div", escaped(name), "name") + element("div", escaped(value), "value") +
                     element("div", escaped(more), "more"),
                 "card") +
         "\n";
}

std::string plan_words(const Eigen::Vector3d& value_m) {
  return length_words(std::max(value_m.x(), value_m.y()));
}

std::string sigma_card(const Product& product) {
  const PointKinds kinds = point_kinds(product);
  const bool by_name = !kinds.named.empty();
  const auto figures = sigma_figures(product, by_name ? kinds.named : kinds.ties);
  if (!figures) return card("Sigma of points", "none", "no point was measured");
  return card(by_name ? "Sigma of named points" : "Sigma of tie points",
              plan_words(figures->median),
              "in plan (median, worse axis); height " + length_words(figures->median.z()));
}

std::string check_card(const Product& product) {
  if (!product.check) return card("Check points", "none given", "predicted, not verified");
  const survey::CheckReport& check = *product.check;
  const std::string whose =
      " at " + counted(static_cast<long long>(check.points.size()), "check point", "check points");
  if (check.same_frame)
    return card("RMSE" + whose, plan_words(check.rmse_m),
                "in plan (worse axis); height " + length_words(check.rmse_m.z()));
  if (!check.best_fit_rmse_m) return card("Check points", "not comparable", "another frame");
  return card("Best-fit RMSE" + whose, plan_words(*check.best_fit_rmse_m),
              "in plan (worse axis); height " + length_words(check.best_fit_rmse_m->z()));
}

std::string ground_sample_card(const Product& product) {
  const auto sample = ground_sample(product);
  if (!sample) return card("Pixel on the ground", "unknown", "");
  return card("Pixel on the ground", length_words(sample->finest_m),
              "from the lowest station; " + length_words(sample->coarsest_m) + " from the highest");
}

std::string in_words(std::string name) {
  if (name.ends_with("_px")) name.resize(name.size() - 3);
  std::replace(name.begin(), name.end(), '_', ' ');
  return name;
}

std::string readable(const std::string& name) {
  std::string words = in_words(name);
  if (!words.empty() && words[0] >= 'a' && words[0] <= 'z')
    words[0] = static_cast<char>(words[0] - 'a' + 'A');
  return words;
}

std::string thresholds_note(const orient::Options& o) {
  return "A quantity is called not observable beyond these standard deviations: azimuth " +
         plain(o.max_azimuth_sigma_deg) + kDegree + ", tilt " + plain(o.max_tilt_sigma_deg) +
         kDegree + ", focal length " + plain(100 * o.max_focal_length_sigma) + " %, scale " +
         plain(100 * o.max_scale_sigma) + " %, height " + plain(100 * o.max_height_sigma) +
         " % of the flying height, position " + plain(o.max_position_sigma_m) +
         " m; or where the data take less than " + plain(100 * o.min_variance_reduction) +
         " % off the variance of the assumption that alone carries it.";
}

std::string level_class(Verdict::Level level) {
  if (level == Verdict::Level::kGood) return "good";
  return level == Verdict::Level::kCaution ? "caution" : "bad";
}

std::string level_mark(const Product& product, Verdict::Level level) {
  if (level == Verdict::Level::kBad) return "Do not rely on this";
  if (level == Verdict::Level::kCaution) return "Use with care";
  return product.check ? "Verified" : "Predicted";
}

std::string signed_figure(double value) { return (value < 0 ? "" : "+") + fixed(value, 3); }

std::string correlation_note(const Product& product) {
  const auto& pairs = product.solution.summary.correlations;
  if (pairs.empty()) return "";
  std::string words;
  for (const orient::Correlation& pair : pairs)
    words += (words.empty() ? "" : "; ") + in_words(pair.a) + " and " + in_words(pair.b) + " (" +
             signed_figure(pair.value) + ")";
  return "Hardly told apart by the data, correlated beyond " +
         plain(product.options.min_correlation) + ": " + words +
         ". One of a pair is no better known than the other; what both make together may be.";
}

std::string weakest_note(const Product& product) {
  std::string words;
  for (const orient::WeakCombination& combination : product.solution.summary.weakest) {
    std::string names;
    for (const auto& [name, correlation] : combination.goes_with)
      names += (names.empty() ? "" : ", ") + in_words(name) + " " + signed_figure(correlation);
    words += (words.empty() ? "" : "; ") + fixed(combination.sigma_rad * kDegPerRad, 3) + kDegree +
             (names.empty() ? " (turns of single photos)" : " (" + names + ")");
  }
  if (words.empty()) return "";
  return "The combinations of camera and photos that are known worst, by the angle that one sigma "
         "moves the images by, and the quantities they go with: " +
         words + ".";
}

}  // namespace

std::string report_header(const Product& product) {
  const std::string words = paragraph("Plumbline \xc2\xb7 measurement report", "over") +
                            element("h1", escaped(product.title)) + "\n" +
                            paragraph(frame_words(product), "sub");
  return element("header", kMark + element("div", words)) + "\n";
}

std::string verdict_box(const Product& product) {
  const Verdict made = verdict(product);
  std::string inner =
      paragraph(level_mark(product, made.level), "mark") + paragraph(made.headline, "headline");
  for (const std::string& sentence : made.sentences) inner += paragraph(sentence);
  return element("div", "\n" + inner, "verdict " + level_class(made.level)) + "\n";
}

std::string key_figures(const Product& product) {
  const orient::Summary& summary = product.solution.summary;
  const survey::Counts& counts = product.counts;
  const PointKinds kinds = point_kinds(product);
  const std::string cards =
      sigma_card(product) + check_card(product) +
      card("Photos used",
           std::to_string(counts.photos_used) + " of " + std::to_string(counts.photos_given),
           "flying height " + fixed_or(summary.flying_height_m, 1, "unknown") + " m") +
      ground_sample_card(product) +
      card("Named points", std::to_string(kinds.named.size()),
           kinds.named.empty() && kinds.not_measured.empty() ? "none given"
           : kinds.not_measured.empty()
               ? "all measured"
               : std::to_string(kinds.not_measured.size()) + " more were not measured") +
      card("Tie points", std::to_string(counts.tie_points),
           std::to_string(counts.tie_points_3plus) + " of them in three photos or more") +
      card("Image sigma", fixed_or(summary.image_sigma_px, 2, "unknown") + " px",
           "reprojection RMS " + fixed_or(summary.reprojection_rms_px, 2, "unknown") + " px") +
      card("Redundancy", std::to_string(summary.redundancy),
           std::to_string(summary.observations_rejected) + " observations rejected");
  return element("div", "\n" + cards, "cards") + "\n";
}

std::string unobservable_section(const Product& product) {
  std::string inner;
  for (const orient::Unobservable& item : product.solution.summary.unobservable)
    inner += element("div", element("h3", escaped(readable(item.name))) + paragraph(item.sentence),
                     "missing") +
             "\n";
  if (inner.empty())
    inner = paragraph("Everything that was asked for is fixed by the measurements.");
  for (const std::string& note : {correlation_note(product), weakest_note(product)})
    if (!note.empty()) inner += paragraph(note);
  return inner + paragraph(thresholds_note(product.options), "note");
}

std::string adjustment_section(const Product& product) {
  const orient::Summary& summary = product.solution.summary;
  const std::string words =
      std::string(summary.converged ? "Converged" : "Did not converge") + " in " +
      counted(summary.iterations, "iteration", "iterations") + "; sigma0 " +
      fixed_or(summary.sigma0, 3, "unknown") + " with redundancy " +
      std::to_string(summary.redundancy) + ". " +
      counted(summary.observations_rejected, "observation was", "observations were") +
      " rejected beyond " + plain(product.options.rejection_sigma) +
      " sigma: not used, listed in observations.csv with used = 0.";
  const std::vector<std::string> missing = point_kinds(product).not_measured;
  std::string names;
  for (std::size_t i = 0; i < missing.size() && i < 50; ++i)
    names += (i == 0 ? "" : ", ") + missing[i];
  if (missing.size() > 50) names += ", ...";
  return paragraph(words) +
         (names.empty()
              ? ""
              : paragraph("Named, but not measured (fewer than two good rays): " + names + ".")) +
         group_table(product);
}

std::string glossary() {
  const auto entry = [](const std::string& term, const std::string& words) {
    return element("dt", escaped(term)) + element("dd", escaped(words)) + "\n";
  };
  return element(
             "dl",
             "\n" +
                 entry("Sigma",
                       "One standard deviation. Two of three errors are smaller than one "
                       "sigma, 95 of 100 smaller than two, per axis.") +
                 entry("Error ellipse", "Drawn at one sigma; the point lies inside with 39 %.") +
                 entry("Shape",
                       "What remains when position, turn, tilt and scale of the whole are "
                       "set aside.") +
                 entry("Best fit",
                       "The check points compared after the measurement was moved, "
                       "turned and scaled onto them.") +
                 entry("Joint NEES",
                       "All differences at the check points weighed together with "
                       "their full covariance. Inside its interval, the stated "
                       "sigmas are honest.") +
                 entry("Predicted",
                       "Computed from the geometry and the image sigma, not compared "
                       "with anything known.")) +
         "\n";
}

std::string report_footer() {
  return element("footer",
                 escaped("Made by Plumbline " PLUMBLINE_VERSION
                         ". The figures of this page are also in summary.json, points.csv, "
                         "photos.csv, observations.csv and camera.toml beside it.")) +
         "\n";
}

}  // namespace plumbline::deliver
