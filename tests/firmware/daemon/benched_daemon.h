// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <string>

#include "tests/firmware/commands/acceptance/program.h"

namespace plumbline::acceptance {

// plumblined at the bench, in real time, with everything that it keeps in `folder`. Several one
// after the other add to one log.
class BenchedDaemon {
 public:
  explicit BenchedDaemon(const fs::path& folder);
  ~BenchedDaemon();  // stops it
  BenchedDaemon(const BenchedDaemon&) = delete;
  BenchedDaemon& operator=(const BenchedDaemon&) = delete;

  // The last status: with all photos of the flight measured after landing, or, where that took
  // longer, without.
  Json wait_for_result(int most_seconds) const;

  // As a service ends it; its exit status.
  int stop();
  // As nothing expects it.
  void kill();

  // The last one, whoever wrote it; empty where there is none.
  Json status() const;
  pid_t process() const { return process_; }
  fs::path flight() const { return folder_ / "bench/flights/0001"; }
  std::string log() const { return text_of(folder_ / "log"); }

 private:
  fs::path folder_;
  pid_t process_ = -1;
};

// Whether a status says that the flight has landed and all `photos` are measured.
bool says_all_measured(const Json& status, std::size_t photos);

}  // namespace plumbline::acceptance
