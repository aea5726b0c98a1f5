// SPDX-License-Identifier: MIT
#include "firmware/commands/orient_command.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "edge/orient/paper/procedure.h"
#include "edge/orient/three_point_frame.h"
#include "edge/survey/check_points.h"
#include "edge/survey/survey.h"
#include "firmware/commands/adjustment_options.h"
#include "firmware/commands/derived_figures.h"
#include "firmware/commands/geo_inputs.h"
#include "firmware/commands/number_check.h"
#include "firmware/commands/run_report.h"
#include "firmware/deliver/text.h"
#include "firmware/ingest/case_folder.h"

namespace plumbline::commands {
namespace {

struct OrientArguments {
  std::filesystem::path folder;
  std::filesystem::path out;
  std::filesystem::path geoid;
  std::string datum = "that of the base";
  bool json = false;
  bool paper = false;
  orient::paper::Priors priors;
  DerivedArguments derived;
  orient::Options adjustment;
};

struct Oriented {
  orient::Solution solution;
  std::optional<orient::paper::Procedure> paper;
};

// The rigorous adjustment, then the frame of three points where there is one.
Result<Oriented> adjusted(const ingest::CaseFolder& input, const OrientArguments& arguments) {
  auto solution = orient::adjust(input.problem, arguments.adjustment);
  if (!solution) return solution.error();
  if (!input.frame_roles) return Oriented{*std::move(solution), std::nullopt};
  auto framed = orient::in_three_point_frame(input.problem, *solution, *input.frame_roles,
                                             arguments.adjustment);
  if (!framed) return framed.error();
  return Oriented{*std::move(framed), std::nullopt};
}

// What the published procedure does not use is named, not passed over.
std::string left_aside(const orient::Problem& problem) {
  const bool stations = std::ranges::any_of(problem.photos, [](const orient::Photo& photo) {
    return photo.station || photo.attitude || photo.heading;
  });
  std::string what;
  if (stations) what += ", positions and attitudes of the photos";
  if (!problem.control.empty()) what += ", control points";
  if (problem.lengths.size() > 1) what += ", lengths but the first";
  return what.empty() ? what : what.substr(2);
}

Result<Oriented> as_published(ingest::CaseFolder& input, const OrientArguments& arguments) {
  if (!input.frame_roles) {
    return Error{
        "The published procedure gives its results in a local frame of three points: "
        "name them in frame.csv (role,point with the roles origin, x_axis, plane)."};
  }
  auto paper = orient::paper::run_procedure(input.problem, *input.frame_roles, arguments.priors,
                                            arguments.adjustment);
  if (!paper) return paper.error();
  input.warnings.push_back(
      "The published procedure is held by weak priors, which its error bars "
      "rest on: " +
      paper->declared + ".");
  if (const std::string what = left_aside(input.problem); !what.empty()) {
    input.warnings.push_back("Given, but not used by the published procedure: " + what + ".");
  }
  orient::Solution solution = paper->solution;
  return Oriented{std::move(solution), *std::move(paper)};
}

// A drone that stands higher is a case in millimetres.
std::string doubt_of_units(const orient::Summary& summary) {
  constexpr double kHighestM = 10'000;
  if (!std::isfinite(summary.common.scale) || !(summary.flying_height_m > kHighestM)) return {};
  return "By what is known the photos were taken " + deliver::fixed(summary.flying_height_m, 0) +
         " m above the ground that they show: give positions, lengths and control in metres.";
}

deliver::Product product_of(ingest::CaseFolder input, Oriented oriented,
                            const OrientArguments& arguments) {
  deliver::Product product;
  product.title = title_of(arguments.folder);
  product.problem = std::move(input.problem);
  product.solution = std::move(oriented.solution);
  product.paper = std::move(oriented.paper);
  product.options = arguments.adjustment;
  product.counts = survey::count(product.problem, product.solution);
  if (!product.solution.frame) product.origin = geo_origin(input.frame);
  product.datum = arguments.datum;
  product.warnings = std::move(input.warnings);
  if (std::string doubt = doubt_of_units(product.solution.summary); !doubt.empty())
    product.warnings.push_back(std::move(doubt));
  product.input_sha256 = std::move(input.input_sha256);
  return product;
}

int run_orient(const OrientArguments& arguments) {
  RunReport report;
  const auto geoid = read_geoid(arguments.geoid);
  if (!geoid) return fail(geoid.error());
  report.progress()("reading", 0, 1);
  auto input = ingest::read_case(arguments.folder, *geoid ? &**geoid : nullptr);
  if (!input) return fail(input.error());
  report.progress()("adjusting", 0, 1);
  auto oriented = arguments.paper ? as_published(*input, arguments) : adjusted(*input, arguments);
  if (!oriented) return fail(oriented.error());
  const auto known = input->check;
  deliver::Product product = product_of(std::move(*input), *std::move(oriented), arguments);
  if (auto status = add_derived_figures(arguments.derived, product); !status) {
    return fail(status.error());
  }
  if (auto status = add_check(known, product); !status) return fail(status.error());
  const auto out = arguments.out.empty() ? arguments.folder / "result" : arguments.out;
  return deliver_result(product, report, out, arguments.json);
}

constexpr const char* kOrientFooter =
    "Example: plumbline orient my_case --out my_case/result\n"
    "         plumbline orient my_case --paper\n"
    "CASE holds (CSV in UTF-8 with one header line, blank = unknown, e/n/u local):\n"
    "  camera.toml       the camera before the adjustment, with [sigma] or [covariance]\n"
    "  photos.csv        photo and what is known of each: e_m,n_m,u_m with sigma_e_m,sigma_n_m,\n"
    "                    sigma_u_m and cov_en_m2,cov_eu_m2,cov_nu_m2; omega_deg,phi_deg,kappa_deg\n"
    "                    with sigma_omega_deg, ...; heading_deg,sigma_heading_deg; time_s;\n"
    "                    ve_m_s,vn_m_s,vu_m_s\n"
    "  observations.csv  photo,point,u_px,v_px[,sigma_px]\n"
    "and may hold\n"
    "  lengths.csv       point_a,point_b,length_m[,sigma_m]\n"
    "  control.csv       point and e_m,n_m,u_m[,sigma_e_m,sigma_n_m,sigma_u_m], or lat_deg,lon_deg "
    "or\n"
    "                    x_north_m,y_east_m,zone with height_ellipsoidal_m or "
    "height_orthometric_m\n"
    "  check.csv         the same columns: compared with the result, never used in it\n"
    "  frame.csv         role,point (origin, x_axis, plane): results in the frame of these points\n"
    "  lever_arm.csv     right_m,up_m,back_m[,sigma_m]: antenna minus camera, in the photo frame\n"
    "  gnss.toml         offset_sigma_m = [h, v], correlation_s, correlated_sigma_m = [h, v],\n"
    "                    delay_s, delay_sigma_s\n"
    "delay_s is positive where the photos were taken later than their positions in photos.csv "
    "hold\n"
    "for: at the exposure the antenna had moved on by delay_s times its velocity.\n"
    "line_time_us (camera.toml) is the time from each row of a photo to the one below it; "
    "position,\n"
    "attitude and time of a photo are those of its middle row.\n"
    "Exit status: 0 good; 1 bad data, no solution, or one that did not converge; 2 wrong usage.";

}  // namespace

void add_orient(CLI::App& app, int& status) {
  auto arguments = std::make_shared<OrientArguments>();
  CLI::App* sub = app.add_subcommand(
      "orient", "the adjustment alone, from measured image coordinates, without images");
  sub->add_option(
         "CASE", arguments->folder,
         "folder with camera.toml, photos.csv, observations.csv and what else is known (below)")
      ->required();
  sub->add_option("--out", arguments->out, "folder for the results (default: CASE/result)");
  sub->add_option("--geoid", arguments->geoid, "geoid model (.pgm or ISG) for orthometric heights");
  sub->add_option("--datum", arguments->datum, "name of the datum, written into the results")
      ->capture_default_str();
  sub->add_flag("--paper", arguments->paper,
                "the procedure of Kunii and Kumazaki 2018, stage by stage, instead of the rigorous "
                "adjustment: one length in lengths.csv and frame.csv, nothing else");
  sub->add_option("--ground-flat", arguments->priors.ground_flat_m,
                  "with --paper: how flat the ground is declared to be, metres (sigma)")
      ->check(number_above_zero())
      ->capture_default_str();
  sub->add_flag("--json", arguments->json, "print summary.json instead of the table");
  add_derived_options(*sub, arguments->derived);
  add_adjustment_options(*sub, arguments->adjustment);
  sub->footer(kOrientFooter);
  sub->callback([arguments, &status] { status = run_orient(*arguments); });
}

}  // namespace plumbline::commands
