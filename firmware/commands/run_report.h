// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "edge/base/progress.h"
#include "edge/base/result.h"
#include "firmware/deliver/product.h"

namespace plumbline::commands {

inline constexpr int kGood = 0;
inline constexpr int kWorkFailed = 1;

// Times the stages of a command and shows them on a terminal (stderr): stage, steps done, time
// gone. In a pipe nothing is shown.
class RunReport {
 public:
  RunReport();
  ~RunReport();
  RunReport(const RunReport&) = delete;
  RunReport& operator=(const RunReport&) = delete;

  Progress progress();
  deliver::Timing timing();  // of the stages so far, and the peak memory of this process

 private:
  void show(const std::string& stage, int done, int total);
  void clear_line();
  void end_stage();

  using Clock = std::chrono::steady_clock;
  bool terminal_;
  std::string stage_;
  Clock::time_point stage_began_;
  deliver::Timing timing_;
};

// "plumbline: sentence" on stderr; returns kWorkFailed.
int fail(const Error& error);

// Writes the result and prints the table (or, with `json`, summary.json) on stdout.
int deliver_result(const deliver::Product& product, RunReport& report,
                   const std::filesystem::path& folder, bool json);

}  // namespace plumbline::commands
