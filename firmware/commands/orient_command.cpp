// SPDX-License-Identifier: MIT
#include "firmware/commands/orient_command.h"

#include <filesystem>
#include <memory>
#include <optional>
#include <utility>

#include "edge/survey/check_points.h"
#include "edge/survey/survey.h"
#include "firmware/commands/adjustment_options.h"
#include "firmware/commands/geo_inputs.h"
#include "firmware/commands/run_report.h"
#include "firmware/ingest/case_folder.h"

namespace plumbline::commands {
namespace {

struct OrientArguments {
  std::filesystem::path folder;
  std::filesystem::path out;
  std::filesystem::path geoid;
  std::string datum = "that of the base";
  bool json = false;
  orient::Options adjustment;
};

deliver::Product product_of(ingest::CaseFolder input, orient::Solution solution,
                            const OrientArguments& arguments) {
  deliver::Product product;
  product.title = title_of(arguments.folder);
  product.problem = std::move(input.problem);
  product.solution = std::move(solution);
  product.options = arguments.adjustment;
  product.counts = survey::count(product.problem, product.solution);
  product.origin = geo_origin(input.frame);
  product.datum = arguments.datum;
  product.warnings = std::move(input.warnings);
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
  if (input->frame_roles) {
    input->warnings.push_back(
        "frame.csv was read but not used: the results are in the frame of photos.csv.");
  }
  report.progress()("adjusting", 0, 1);
  auto solution = orient::adjust(input->problem, arguments.adjustment);
  if (!solution) return fail(solution.error());
  const auto known = input->check;
  deliver::Product product = product_of(std::move(*input), std::move(*solution), arguments);
  if (!known.empty()) {
    auto check = survey::check(product.problem, product.solution, known);
    if (!check) return fail(check.error());
    product.check = std::move(*check);
  }
  const auto out = arguments.out.empty() ? arguments.folder / "result" : arguments.out;
  return deliver_result(product, report, out, arguments.json);
}

}  // namespace

void add_orient(CLI::App& app, int& status) {
  auto arguments = std::make_shared<OrientArguments>();
  CLI::App* sub = app.add_subcommand(
      "orient", "the adjustment alone, from measured image coordinates, without images");
  sub->add_option("CASE", arguments->folder,
                  "folder with camera.toml, photos.csv, observations.csv and what else is known")
      ->required();
  sub->add_option("--out", arguments->out, "folder for the results (default: CASE/result)");
  sub->add_option("--geoid", arguments->geoid, "geoid model (.pgm or ISG) for orthometric heights");
  sub->add_option("--datum", arguments->datum, "name of the datum, written into the results")
      ->capture_default_str();
  sub->add_flag("--json", arguments->json, "print summary.json instead of the table");
  add_adjustment_options(*sub, arguments->adjustment);
  sub->footer("Example: plumbline orient my_case --out my_case/result");
  sub->callback([arguments, &status] { status = run_orient(*arguments); });
}

}  // namespace plumbline::commands
