// SPDX-License-Identifier: MIT
#include "firmware/service/life/service_manager.h"

#include <systemd/sd-daemon.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>

namespace plumbline::service {
namespace {

Status notify(const std::string& state) {
  const int sent = ::sd_notify(0, state.c_str());
  if (sent >= 0) return Done{};
  return Error{std::string("The service manager cannot be told: ") + std::strerror(-sent) + "."};
}

// A line of the protocol ends where the line ends.
std::string status_line(std::string sentence) {
  std::replace(sentence.begin(), sentence.end(), '\n', ' ');
  return "STATUS=" + sentence;
}

}  // namespace

bool ServiceManager::is_there() const { return std::getenv("NOTIFY_SOCKET") != nullptr; }

Status ServiceManager::ready(const std::string& sentence) const {
  return notify("READY=1\n" + status_line(sentence));
}

Status ServiceManager::show(const std::string& sentence) const {
  return notify(status_line(sentence));
}

Status ServiceManager::lives() const { return notify("WATCHDOG=1"); }

Status ServiceManager::stopping() const { return notify("STOPPING=1"); }

}  // namespace plumbline::service
