// SPDX-License-Identifier: MIT
#include "tests/firmware/daemon/benched_daemon.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <iterator>
#include <thread>

namespace plumbline::acceptance {
namespace {

std::size_t files_in(const fs::path& folder) {
  std::error_code none;
  const fs::directory_iterator files(folder, none);
  return static_cast<std::size_t>(std::distance(begin(files), end(files)));
}

}  // namespace

BenchedDaemon::BenchedDaemon(const fs::path& folder) : folder_(folder) {
  process_ = ::fork();
  if (process_ != 0) return;
  const int log = ::open((folder / "log").c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
  ::dup2(log, STDERR_FILENO);
  const std::string bench = folder / "bench";
  ::execl(PLUMBLINE_DAEMON, PLUMBLINE_DAEMON, "--bench", bench.c_str(), nullptr);
  ::_exit(127);
}

BenchedDaemon::~BenchedDaemon() { stop(); }

Json BenchedDaemon::wait_for_result(int most_seconds) const {
  Json status;
  for (int k = 0; k < 10 * most_seconds; ++k) {
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
    status = this->status();
    if (says_all_measured(status, files_in(flight() / "photos"))) break;
  }
  return status;
}

int BenchedDaemon::stop() {
  if (process_ <= 0) return -1;
  ::kill(process_, SIGTERM);
  int status = -1;
  ::waitpid(process_, &status, 0);
  process_ = -1;
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void BenchedDaemon::kill() {
  ::kill(process_, SIGKILL);
  ::waitpid(process_, nullptr, 0);
  process_ = -1;
}

Json BenchedDaemon::status() const {
  return Json::parse(text_of(folder_ / "bench/status.json"), nullptr, false);
}

bool says_all_measured(const Json& status, std::size_t photos) {
  if (!status.is_object() || status.value("last_flight", "").empty()) return false;
  const std::string all = "Measured from " + std::to_string(photos) + " photos";
  return status.value("result", "").find(all) != std::string::npos;
}

}  // namespace plumbline::acceptance
