// SPDX-License-Identifier: MIT
#include "firmware/commands/gnss_command.h"

#include <fcntl.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <memory>
#include <string>

#include "edge/base/result.h"
#include "edge/gnss/log_parser.h"
#include "firmware/commands/gnss_live.h"
#include "firmware/commands/gnss_output.h"
#include "firmware/devices_on_board.h"

namespace plumbline::commands {
namespace {

struct GnssArguments {
  std::string source;
  int baud = 0;
  bool json = false;
};

std::string shown_name(const std::string& source) {
  return source == "-" ? "standard input" : "'" + source + "'";
}

Error cannot_read(const std::string& source, const std::string& why) {
  return {"Cannot read " + shown_name(source) + ": " + why + "."};
}

// A host, or what is or may yet become a port: its node may be missing while it is unplugged.
bool is_live(const std::string& source) {
  if (source.starts_with("tcp://")) return true;
  const std::filesystem::path path = source.substr(0, source.find('@'));
  if (path == "/dev/stdin" || path == "/dev/null") return false;
  std::error_code error;
  if (std::filesystem::exists(path, error)) {
    return std::filesystem::is_character_file(path, error);
  }
  return path.string().starts_with("/dev/");
}

// An open file of which the destructor closes what it opened.
class Input {
 public:
  explicit Input(const std::string& source)
      : owned_(source != "-"), fd_(owned_ ? ::open(source.c_str(), O_RDONLY | O_CLOEXEC) : 0) {}
  ~Input() {
    if (owned_ && fd_ >= 0) ::close(fd_);
  }
  Input(const Input&) = delete;
  Input& operator=(const Input&) = delete;

  int fd() const { return fd_; }

 private:
  bool owned_;
  int fd_;
};

Result<Input*> opened(Input& input, const std::string& source) {
  if (input.fd() < 0) return cannot_read(source, std::strerror(errno));
  return &input;
}

// Hands on what there is as soon as it is there: a pipe may be live.
Status pump(int fd, const std::string& source, gnss::LogParser& parser) {
  std::array<char, 65536> chunk{};
  while (true) {
    const ssize_t count = ::read(fd, chunk.data(), chunk.size());
    if (count == 0) break;
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) return cannot_read(source, std::strerror(errno));
    parser.feed({chunk.data(), static_cast<std::size_t>(count)});
    std::fflush(stdout);
  }
  parser.finish();
  return Done{};
}

Status show_receiver(const GnssArguments& arguments) {
  const auto clock = make_clock();
  std::string address = arguments.source;
  if (arguments.baud != 0) address += "@" + std::to_string(arguments.baud);
  const auto receiver = make_receiver(address, *clock);
  if (!receiver) return receiver.error();
  return show_live(**receiver, *clock, arguments.json);
}

Status show_log(const GnssArguments& arguments) {
  const std::string& source = arguments.source;
  Input input(source);
  if (const auto open = opened(input, source); !open) return open.error();
  bool first = true;
  gnss::LogParser parser([&](const GnssFix& fix) {
    if (!arguments.json && std::exchange(first, false)) print_table_head();
    print_fix(fix, arguments.json);
  });
  if (const Status read = pump(input.fd(), source, parser); !read) return read;
  const DecoderCounters& counters = parser.counters();
  if (counters.sentences == 0) {
    return Error{shown_name(source) + " " + parser.reason_for_nothing() + "."};
  }
  if (counters.epochs == 0) {
    std::fprintf(stderr, "%s %s.\n", shown_name(source).c_str(),
                 parser.reason_for_nothing().c_str());
  }
  print_counters(counters, std::nullopt, arguments.json);
  return Done{};
}

Status show(const GnssArguments& arguments) {
  if (arguments.source.empty()) {
    print_ports(list_serial_ports(), arguments.json);
    return Done{};
  }
  return is_live(arguments.source) ? show_receiver(arguments) : show_log(arguments);
}

}  // namespace

void add_gnss(CLI::App& app, int& status) {
  auto arguments = std::make_shared<GnssArguments>();
  CLI::App* gnss = app.add_subcommand("gnss", "What a receiver says, live or from a log");
  gnss->add_option("source", arguments->source,
                   "Serial port or tcp://HOST:PORT, live until Ctrl-C; NMEA or RTKLIB log (.llh, "
                   ".pos); - for standard input; without one the serial ports are listed")
      ->type_name("PORT|FILE|-");
  gnss->add_option("--baud", arguments->baud,
                   "Speed of a serial port, found without it; of no effect on files")
      ->check(CLI::Range(300, 4000000));
  gnss->add_flag("--json", arguments->json, "One JSON object per position epoch, counters last");
  gnss->footer("Example: plumbline gnss /dev/ttyACM0\nplumbline gnss flight.nmea --json | head -3");
  gnss->callback([arguments, &status] {
    const Status shown = show(*arguments);
    std::fflush(stdout);
    if (!shown) std::fprintf(stderr, "%s\n", shown.error().sentence.c_str());
    status = shown ? 0 : 1;
  });
}

}  // namespace plumbline::commands
