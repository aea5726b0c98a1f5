// SPDX-License-Identifier: MIT
// What the daemon takes of the computer while it flies: its share of one core and its resident
// memory, as the kernel counts them, over the climb of a simulated flight that a pseudo-terminal
// brings at 10 Hz with its real sentences. Without a camera: what frames and their encoding take
// depends on the camera. Fails where it is more than 3 % or 60 MB. Takes a minute and a half.
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <sstream>
#include <string>
#include <thread>

#include "drivers/posix/system_clock.h"
#include "edge/geodesy/local_frame.h"
#include "sim/climb_path.h"
#include "sim/gnss_stream.h"
#include "sim/live_port.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr double kMostOfACore = 0.03;
constexpr double kMostMegabytes = 60;
constexpr double kWait_s = 10;
constexpr double kFlown_s = 60;

struct Taken {
  double cpu_s = 0;
  double resident_mb = 0;  // the most so far
};

// proc(5): fields 14 and 15 of stat, VmHWM of status.
Taken taken_by(pid_t process) {
  const std::string folder = "/proc/" + std::to_string(process);
  std::ifstream stat(folder + "/stat");
  std::string text((std::istreambuf_iterator<char>(stat)), {});
  std::istringstream fields(text.substr(text.rfind(')') + 2));
  std::string field;
  for (int number = 3; number < 14; ++number) fields >> field;
  double user_ticks = 0, system_ticks = 0;
  fields >> user_ticks >> system_ticks;
  Taken taken;
  taken.cpu_s = (user_ticks + system_ticks) / static_cast<double>(::sysconf(_SC_CLK_TCK));
  std::ifstream status(folder + "/status");
  for (std::string line; std::getline(status, line);) {
    if (line.starts_with("VmHWM:")) taken.resident_mb = std::atof(line.c_str() + 6) / 1024;
  }
  return taken;
}

class Daemon {
 public:
  explicit Daemon(const fs::path& folder) {
    std::ofstream(folder / "plumbline.toml")
        << "[receiver]\naddress = \"" << (folder / "receiver").string()
        << "\"\n[camera]\nid = \"/dev/none\"\n[recording]\nfolder = \"" << folder.string()
        << "/flights\"\n[status]\nfile = \"" << folder.string() << "/status.json\"\nsocket = \""
        << folder.string() << "/sock\"\n";
    fs::create_directories(folder / "flights");
    process_ = ::fork();
    if (process_ != 0) return;
    const std::string config = folder / "plumbline.toml";
    ::execl(PLUMBLINE_DAEMON, PLUMBLINE_DAEMON, "--config", config.c_str(), nullptr);
    ::_exit(127);
  }
  ~Daemon() {
    ::kill(process_, SIGTERM);
    ::waitpid(process_, nullptr, 0);
  }
  Daemon(const Daemon&) = delete;
  Daemon& operator=(const Daemon&) = delete;

  pid_t process() const { return process_; }

 private:
  pid_t process_ = -1;
};

bool is_flying(const fs::path& folder) {
  std::ifstream file(folder / "status.json");
  const auto status = nlohmann::json::parse(file, nullptr, false);
  return status.is_object() && status.value("phase", "") == "flying";
}

void sleep(double seconds) { std::this_thread::sleep_for(std::chrono::duration<double>(seconds)); }

int measure_in(const fs::path& folder) {
  posix::SystemClock clock;
  sim::ClimbPathOptions climb;
  climb.wait_s = kWait_s;
  climb.climb_m_s = 1.5;
  const sim::ClimbPath path(climb, 1);
  const auto frame = *geodesy::LocalFrame::at({35.66, 139.76, 52.3});
  sim::GnssStreamOptions options;
  options.interval = std::chrono::milliseconds(100);
  options.host_at_start = clock.now();
  options.utc_at_start = std::chrono::floor<std::chrono::seconds>(clock.wall().wall);
  sim::GnssStream stream([&](double s) { return frame.geodetic_of(path.at(s)); }, options, 1);
  sim::LivePort port(clock, (folder / "receiver").string(),
                     [&] { return std::optional<sim::LinePiece>(stream.next()); });
  if (const Status started = port.start(); !started) {
    std::printf("%s\n", started.error().sentence.c_str());
    return 1;
  }
  const Daemon daemon(folder);
  sleep(kWait_s + 8);
  if (!is_flying(folder)) {
    std::printf("the daemon has not noticed that it flies\n");
    return 1;
  }
  const Taken before = taken_by(daemon.process());
  sleep(kFlown_s);
  const Taken after = taken_by(daemon.process());
  const double share = (after.cpu_s - before.cpu_s) / kFlown_s;
  std::printf("in flight at 10 Hz: %.2f %% of one core, %.1f MB resident at most\n", 100 * share,
              after.resident_mb);
  return share <= kMostOfACore && after.resident_mb <= kMostMegabytes ? 0 : 1;
}

int run() {
  std::string pattern = (fs::temp_directory_path() / "plumbline-daemon-XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  const int status = measure_in(folder);
  fs::remove_all(folder);
  return status;
}

}  // namespace
}  // namespace plumbline

int main() { return plumbline::run(); }
