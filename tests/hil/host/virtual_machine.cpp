// SPDX-License-Identifier: MIT
#include "tests/hil/host/virtual_machine.h"

#include <cstdlib>

namespace plumbline::hil {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr const char* kEnd = "=== ";
constexpr std::chrono::seconds kOfQemu(10);

}  // namespace

// What comes first may be the answer to an order of an earlier connection.
bool GuestShell::open(const std::string& socket, std::chrono::seconds at_most) {
  const std::string word = "here-" + std::to_string(SteadyClock::now().time_since_epoch().count());
  if (!lines_.open(socket) || !lines_.say("echo " + word)) return false;
  const auto deadline = SteadyClock::now() + at_most;
  bool heard = false;
  while (const auto line = lines_.next(deadline)) {
    if (heard && line->starts_with(kEnd)) return true;
    heard |= *line == word;
  }
  return false;
}

std::optional<GuestShell::Answer> GuestShell::run(const std::string& command,
                                                  std::chrono::seconds at_most) {
  const auto deadline = SteadyClock::now() + at_most;
  if (!lines_.say(command)) return std::nullopt;
  Answer answer;
  while (const auto line = lines_.next(deadline)) {
    if (line->starts_with(kEnd)) {
      answer.status = std::atoi(line->c_str() + 4);
      return answer;
    }
    answer.output += *line + "\n";
  }
  return std::nullopt;
}

bool Cables::open(const std::string& socket) {
  return lines_.open(socket) && ask(R"({"execute":"qmp_capabilities"})", R"("return")");
}

// The answer to a pull comes before the device is gone.
bool Cables::pull(const std::string& id) {
  return ask(R"({"execute":"device_del","arguments":{"id":")" + id + R"("}})",
             R"("DEVICE_DELETED")");
}

bool Cables::plug(const std::string& device) {
  return ask(R"({"execute":"device_add","arguments":)" + device + "}", R"("return")");
}

bool Cables::ask(const std::string& request, const std::string& until) {
  if (!lines_.say(request)) return false;
  const auto deadline = SteadyClock::now() + kOfQemu;
  while (const auto line = lines_.next(deadline)) {
    if (line->find(R"("error")") != std::string::npos) return false;
    if (line->find(until) != std::string::npos) return true;
  }
  return false;
}

}  // namespace plumbline::hil
