// SPDX-License-Identifier: MIT
#include "firmware/commands/config_command.h"

#include <filesystem>
#include <iostream>
#include <memory>
#include <string>

#include "firmware/commands/commands.h"
#include "firmware/commands/config_output.h"
#include "firmware/commands/run_report.h"
#include "firmware/config/config_text.h"
#include "firmware/config/config_toml.h"

namespace plumbline::commands {
namespace {

struct ConfigArguments {
  std::filesystem::path file;
  bool example = false;
  bool json = false;
};

int check(const ConfigArguments& arguments) {
  const auto reading = config::read_config(arguments.file);
  if (!reading) return fail(reading.error());
  const std::string file = arguments.file.string();
  if (arguments.json) std::cout << config_json(file, *reading);
  for (const Error& error : reading->errors) fail(error);
  if (!reading->errors.empty()) return kWorkFailed;
  if (!arguments.json) std::cout << file << ": good\n" << config_lines(reading->config);
  return kGood;
}

int run_config(const ConfigArguments& arguments) {
  if (!arguments.example && arguments.file.empty()) {
    std::cerr << "plumbline: Say --check FILE or --example; see plumbline config --help.\n";
    return kWrongUsage;
  }
  if (!arguments.example) return check(arguments);
  std::cout << config::config_example();
  return kGood;
}

}  // namespace

void add_config(CLI::App& app, int& status) {
  auto arguments = std::make_shared<ConfigArguments>();
  CLI::App* sub =
      app.add_subcommand("config", "is plumblined's configuration good, and an example");
  CLI::Option* example = sub->add_flag("--example", arguments->example,
                                       "print a file with every key, its range and its default");
  sub->add_option("--check", arguments->file,
                  "say all that is wrong in FILE, or what it amounts to")
      ->option_text("FILE")
      ->excludes(example);
  sub->add_flag("--json", arguments->json, "print one JSON object: all keys with their values")
      ->excludes(example);
  sub->footer(
      "Example: plumbline config --check /etc/plumbline/plumbline.toml\n"
      "         plumbline config --example > plumbline.toml");
  sub->callback([arguments, &status] { status = run_config(*arguments); });
}

}  // namespace plumbline::commands
