// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <functional>
#include <string>
#include <vector>

namespace plumbline::commands {

struct CommandRun {
  int status = -1;  // as the program would end
  std::string printed;
  std::string told;  // on stderr
};

// Runs, in this process, a program that has the commands that `add` puts in.
inline CommandRun run_command(const std::function<void(CLI::App&, int&)>& add,
                              std::vector<std::string> arguments) {
  CLI::App app;
  CommandRun run;
  add(app, run.status);
  std::reverse(arguments.begin(), arguments.end());
  testing::internal::CaptureStderr();
  testing::internal::CaptureStdout();
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& error) {
    run.status = error.get_exit_code() == 0 ? 0 : 2;
  }
  run.printed = testing::internal::GetCapturedStdout();
  run.told = testing::internal::GetCapturedStderr();
  return run;
}

}  // namespace plumbline::commands
