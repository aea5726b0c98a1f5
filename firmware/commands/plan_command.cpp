// SPDX-License-Identifier: MIT
#include "firmware/commands/plan_command.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "edge/plan/model.h"
#include "edge/plan/plan.h"
#include "firmware/commands/adjustment_options.h"
#include "firmware/commands/commands.h"
#include "firmware/commands/number_check.h"
#include "firmware/commands/plan_output.h"
#include "firmware/commands/run_report.h"
#include "firmware/ingest/camera_toml.h"

namespace plumbline::commands {
namespace {

struct PlanArguments {
  std::filesystem::path camera;
  std::string profile;
  // Each of these stands for that of the profile where given.
  std::optional<double> from_m, to_m, step_m;
  std::vector<double> side_steps_m;
  std::vector<double> rtk_m;
  plan::Options options;
  bool json = false;
};

int wrong(const Error& error) {
  std::cerr << "plumbline: " << error.sentence << " See plumbline plan --help.\n";
  return kWrongUsage;
}

// A climb of one's own has no side-step unless one is given; without any figure it is `standard`.
Result<plan::Climb> wanted_climb(const PlanArguments& arguments) {
  plan::Climb climb;
  if (!arguments.profile.empty() || !(arguments.from_m || arguments.to_m)) {
    climb = *plan::named_climb(arguments.profile.empty() ? "standard" : arguments.profile);
  } else if (!(arguments.from_m && arguments.to_m)) {
    return Error{"A climb needs both --from and --to (or a --profile)."};
  }
  if (arguments.from_m) climb.from_m = *arguments.from_m;
  if (arguments.to_m) climb.to_m = *arguments.to_m;
  if (arguments.step_m) climb.step_m = *arguments.step_m;
  if (!arguments.side_steps_m.empty()) climb.side_steps_m = arguments.side_steps_m;
  if (auto status = plan::check(climb); !status) return status.error();
  return climb;
}

int run_plan(const PlanArguments& arguments) {
  const auto climb = wanted_climb(arguments);
  if (!climb) return wrong(climb.error());
  plan::Options options = arguments.options;
  if (!arguments.rtk_m.empty()) options.rtk = plan::Rtk{arguments.rtk_m[0], arguments.rtk_m[1]};
  const auto camera = ingest::read_camera_toml(arguments.camera);
  if (!camera) return fail(camera.error());
  for (const std::string& notice : camera->notices) std::cerr << "plumbline: " << notice << '\n';
  options.camera = camera->camera;
  const plan::Flight flight = plan::flight_of(*climb);
  if (auto status = plan::check(flight, options); !status) return wrong(status.error());
  const auto summary = plan::plan(flight, options);
  if (!summary) return fail(summary.error());
  std::cout << (arguments.json ? plan_json(*summary, flight, options)
                               : plan_table(*summary, flight, options));
  return kGood;
}

void add_flight_options(CLI::App& sub, PlanArguments& arguments) {
  sub.add_option("--profile", arguments.profile,
                 "paper, standard or ice: a climb by name; what else is given stands for its part")
      ->check(CLI::IsMember({"paper", "standard", "ice"}));
  sub.add_option("--from", arguments.from_m, "lowest height above the ground, metres")
      ->check(number_within(1.0, 10'000.0));
  sub.add_option("--to", arguments.to_m, "highest height, metres")
      ->check(number_within(1.0, 10'000.0));
  sub.add_option("--step", arguments.step_m, "height between photos, metres (5)")
      ->check(number_within(0.05, 10'000.0));
  sub.add_option("--side-step", arguments.side_steps_m,
                 "metres aside at the top; two (10,10) make an L; 0: none")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(number_within(0.0, 1000.0));
}

void add_known_options(CLI::App& sub, PlanArguments& arguments) {
  plan::Options& options = arguments.options;
  sub.add_option("--rtk", arguments.rtk_m,
                 "white sigma H,V of the positions, metres; without it only local sigmas are given")
      ->delimiter(',')
      ->expected(2)
      ->check(number_within(1e-5, 1000.0));
  sub.add_option("--heading-sigma", options.heading_sigma_deg,
                 "a compass with this sigma, degrees, its error common to all photos")
      ->check(number_within(0.001, 180.0));
  sub.add_option("--known-length", options.known_length_m,
                 "a length known on the ground, metres, centred on the foot")
      ->check(number_within(0.01, 10'000.0));
  sub.add_option("--length-sigma", options.length_sigma_m, "its sigma, metres")
      ->check(number_within(1e-5, 10.0))
      ->capture_default_str();
  sub.add_option("--control-points", options.control_points,
                 "so many points of known position, far from the foot")
      ->check(CLI::Range(0, 100))
      ->capture_default_str();
  sub.add_option("--control-sigma", options.control_sigma_m, "their sigma, each axis, metres")
      ->check(number_within(1e-5, 10.0))
      ->capture_default_str();
}

void add_scene_options(CLI::App& sub, PlanArguments& arguments) {
  plan::Options& options = arguments.options;
  sub.add_option("--sigma-px", options.sigma_px, "sigma of an image coordinate, pixels")
      ->check(number_within(1e-4, 1000.0))
      ->capture_default_str();
  sub.add_option("--ties", options.ties, "points seen in two photos or more")
      ->check(CLI::Range(10, 1'000'000))
      ->capture_default_str();
  sub.add_option("--radius", options.radius_m,
                 "the ground that matters: metres around the foot (default: what the shorter side "
                 "of the picture sees from the middle height)")
      ->check(number_within(0.1, 10'000.0));
  sub.add_option("--tilt", options.tilt_deg, "how far the camera will tilt, RMS, degrees")
      ->check(number_within(0.0, 20.0))
      ->capture_default_str();
  sub.add_option("--wander", options.wander_m,
                 "how far the drone will stray from the line, RMS of each axis, metres; a straight "
                 "line promises no azimuth by luck")
      ->check(number_within(0.0, 100.0))
      ->capture_default_str();
}

constexpr const char* kFooter =
    "Example: plumbline plan --camera camera.toml --from 70 --to 90 --step 5 --rtk 0.005,0.010 "
    "--goal 0.05\n"
    "Profiles: paper 70 to 90 m every 5 m; standard 30 to 90 m every 5 m, then 10 m aside;\n"
    "          ice 10 to 60 m every 2.5 m, then 5 m aside.\n"
    "Costs: 2 m/s up, down and aside, back again, 2 s for each photo; photos lower down or in "
    "between cost\n"
    "       their 2 s alone; a compass of 2 degrees 300 s, of 1 degree 600 s, a known length "
    "400 s, a control\n"
    "       point 900 s of work on the ground.\n"
    "The goal holds where sigma in plan (each axis) and in height are within it in every ring "
    "within the radius:\n"
    "absolute sigmas with --rtk, local ones without.";

}  // namespace

void add_plan(CLI::App& app, int& status) {
  auto arguments = std::make_shared<PlanArguments>();
  CLI::App* sub = app.add_subcommand(
      "plan", "the sigmas of a flight before it is flown, and the cheapest change that helps");
  sub->add_option("--camera", arguments->camera, "the camera, with the sigmas of its calibration")
      ->required();
  add_flight_options(*sub, *arguments);
  add_known_options(*sub, *arguments);
  add_scene_options(*sub, *arguments);
  sub->add_option("--goal", arguments->options.goal_m, "sigma to reach, metres")
      ->check(number_within(1e-6, 1000.0));
  sub->add_option("--ceiling", arguments->options.ceiling_m, "no change flies higher, metres")
      ->check(number_within(1.0, 10'000.0))
      ->capture_default_str();
  sub->add_flag("--json", arguments->json, "print one JSON object instead of the table");
  add_adjustment_options(*sub, arguments->options.adjustment);
  sub->footer(kFooter);
  sub->callback([arguments, &status] { status = run_plan(*arguments); });
}

}  // namespace plumbline::commands
