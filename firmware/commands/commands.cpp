// SPDX-License-Identifier: MIT
#include "firmware/commands/commands.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <exception>
#include <functional>
#include <iostream>
#include <string>

#include "firmware/commands/camera_command.h"
#include "firmware/commands/check_command.h"
#include "firmware/commands/config_command.h"
#include "firmware/commands/gnss_command.h"
#include "firmware/commands/measure_command.h"
#include "firmware/commands/orient_command.h"
#include "firmware/commands/plan_command.h"
#include "firmware/commands/replay_command.h"
#include "firmware/commands/run_report.h"
#include "firmware/commands/sim_command.h"
#include "firmware/commands/status_command.h"

namespace plumbline::commands {
namespace {

// Which command was meant, for the pointer to its help; empty where there is none.
std::string command_of(const CLI::App& app, int argc, char** argv) {
  if (argc < 2) return {};
  const std::string word = argv[1];
  for (const CLI::App* command : app.get_subcommands(std::function<bool(const CLI::App*)>())) {
    if (command->check_name(word)) return word + " ";
  }
  return {};
}

int wrong_usage(const CLI::App& app, const CLI::ParseError& wrong, int argc, char** argv) {
  const std::string command = command_of(app, argc, argv);
  std::string what = wrong.what();
  if (command.empty() && argc > 1 && argv[1][0] != '-') {
    what = "There is no command '" + std::string(argv[1]) + "'";
  } else if (command.empty() && argc < 2) {
    what =
        "A command is required: measure, orient, plan, sim, gnss, camera, replay, check, status "
        "or config";
  }
  std::replace(what.begin(), what.end(), '\n', ' ');
  std::cerr << "plumbline: " << what << "; see plumbline " << command << "--help.\n";
  return kWrongUsage;
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"Plumbline: from photos of a vertical climb to ground points with error bars."};
  app.name("plumbline");
  app.set_version_flag("--version", PLUMBLINE_VERSION);
  app.require_subcommand(1);
  app.footer(
      "Example: plumbline measure photos/ --out result/\nplumbline COMMAND --help has more.");
  int status = kGood;
  add_measure(app, status);
  add_orient(app, status);
  add_plan(app, status);
  add_sim(app, status);
  add_gnss(app, status);
  add_camera(app, status);
  add_replay(app, status);
  add_check(app, status);
  add_status(app, status);
  add_config(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& wrong) {
    return wrong_usage(app, wrong, argc, argv);
  }
  return status;
}

}  // namespace

int run(int argc, char** argv) {
  try {
    return parse_and_run(argc, argv);
  } catch (const std::exception& broken) {  // memory, or a full disk in a library's stream
    return fail({std::string("The work was stopped: ") + broken.what() + "."});
  }
}

}  // namespace plumbline::commands
