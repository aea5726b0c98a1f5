// SPDX-License-Identifier: MIT
#include "firmware/commands/commands.h"

#include <CLI/CLI.hpp>
#include <exception>
#include <iostream>

#include "firmware/commands/gnss_command.h"
#include "firmware/commands/measure_command.h"
#include "firmware/commands/orient_command.h"
#include "firmware/commands/run_report.h"
#include "firmware/commands/sim_command.h"

namespace plumbline::commands {
namespace {

constexpr int kWrongUsage = 2;

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
  add_sim(app, status);
  add_gnss(app, status);
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& wrong) {
    app.exit(wrong);
    return kWrongUsage;
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
