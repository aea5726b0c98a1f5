// SPDX-License-Identifier: MIT
#include "firmware/commands/status_command.h"

#include <sys/socket.h>
#include <sys/un.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>

#include "firmware/commands/run_report.h"
#include "firmware/config/config.h"

namespace plumbline::commands {
namespace {

struct StatusArguments {
  std::string socket = config::Config{}.status.socket;
  bool watch = false;
  bool json = false;
};

// A connection to the daemon, which writes a line of JSON at once, whenever something changes, and
// every second.
class DaemonLines {
 public:
  ~DaemonLines() {
    if (fd_ >= 0) ::close(fd_);
  }
  Status connect(const std::string& path) {
    sockaddr_un address{};
    address.sun_family = AF_UNIX;
    if (path.size() >= sizeof address.sun_path) return Error{path + " is too long for a socket."};
    std::memcpy(address.sun_path, path.c_str(), path.size() + 1);
    fd_ = ::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0);
    if (fd_ >= 0 &&
        ::connect(fd_, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0) {
      return Done{};
    }
    return Error{
        "No daemon answers at " + path + " (" + std::strerror(errno) +
        "): is plumblined running, and is this its socket? Where it is a service, journalctl -u "
        "plumblined says why it does not start."};
  }
  // Empty when the daemon has gone.
  std::string next() {
    for (;;) {
      const std::size_t end = text_.find('\n');
      if (end != std::string::npos) {
        std::string line = text_.substr(0, end);
        text_.erase(0, end + 1);
        return line;
      }
      char bytes[4096];
      const ssize_t size = ::read(fd_, bytes, sizeof bytes);
      if (size < 0 && errno == EINTR) continue;
      if (size <= 0) return {};
      text_.append(bytes, static_cast<std::size_t>(size));
    }
  }

 private:
  int fd_ = -1;
  std::string text_;
};

// The sentence of a line; the whole of one that has none.
std::string sentence_of(const std::string& line) {
  const auto status = nlohmann::json::parse(line, nullptr, false);
  return status.is_object() ? status.value("sentence", line) : line;
}

void show(const std::string& text) {
  std::printf("%s\n", text.c_str());
  std::fflush(stdout);
}

int run_status(const StatusArguments& arguments) {
  DaemonLines daemon;
  if (const Status connected = daemon.connect(arguments.socket); !connected) {
    return fail(connected.error());
  }
  std::string line = daemon.next();
  if (line.empty()) return fail({"The daemon closed the connection: see its journal."});
  std::string shown;
  do {
    std::string text = arguments.json ? line : sentence_of(line);
    if (text != shown) show(text);
    shown = std::move(text);
  } while (arguments.watch && !(line = daemon.next()).empty());
  return arguments.watch ? fail({"The daemon has stopped."}) : kGood;
}

}  // namespace

void add_status(CLI::App& app, int& status) {
  auto arguments = std::make_shared<StatusArguments>();
  CLI::App* command = app.add_subcommand("status", "What the daemon is doing, in one line.");
  command->add_flag("--watch", arguments->watch, "a line for every change, until it stops");
  command->add_flag("--json", arguments->json, "all of it, an object a line, every second");
  command->add_option("--socket", arguments->socket, "the daemon's socket")->capture_default_str();
  command->footer("Example: plumbline status --watch");
  command->callback([arguments, &status] { status = run_status(*arguments); });
}

}  // namespace plumbline::commands
