// SPDX-License-Identifier: MIT
#include <pthread.h>

#include <CLI/CLI.hpp>
#include <atomic>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <utility>

#include "drivers/patient_line.h"
#include "firmware/config/config_toml.h"
#include "firmware/devices_in_sim.h"
#include "firmware/devices_on_board.h"
#include "firmware/ingest/text_file.h"
#include "firmware/service/camera_finder.h"
#include "firmware/service/daemon.h"
#include "firmware/service/life/life_signs.h"

namespace plumbline {
namespace {

constexpr int kWorkFailed = 1;
constexpr int kWrongUsage = 2;
constexpr std::chrono::seconds kRest{2};

int fail(const std::string& sentence) {
  std::cerr << "plumblined: " << sentence << '\n';
  return kWorkFailed;
}

// Everything that the configuration names: real, or at the bench simulated where it says so.
struct Devices {
  std::unique_ptr<Clock> clock = make_clock();
  std::unique_ptr<SimulatedBench> bench;
  std::unique_ptr<Storage> storage;
  std::unique_ptr<GnssReceiver> receiver;
  std::unique_ptr<Camera> camera;
  std::unique_ptr<TriggerLine> release;
  std::unique_ptr<TriggerLine> pulse_per_second;
  std::unique_ptr<PilotLink> pilot;
  PatientLine* late_release = nullptr;  // those of the lines that may come later
  PatientLine* late_pulses = nullptr;

  flight::Devices lent() {
    return {*clock,     *storage, *receiver, camera.get(), release.get(), pulse_per_second.get(),
            pilot.get()};
  }
};

template <typename T>
Status put(Result<std::unique_ptr<T>> made, std::unique_ptr<T>& place) {
  if (!made) return made.error();
  place = std::move(made).value();
  return Done{};
}

bool is_simulated(const Devices& devices, const std::string& name) {
  return devices.bench && name == SimulatedBench::kSimulated;
}

Status make_the_camera(const config::Config& config, Devices& devices) {
  if (is_simulated(devices, config.camera.id)) {
    const bool released = config.capture.release.release == capture::Release::kPulse;
    devices.camera = devices.bench->make_camera(released);
    return Done{};
  }
  const std::string& id = config.camera.id;
  if (id.empty() || id == config::CameraConfig::kNone) return Done{};  // found later, or elsewhere
  return put(make_camera(id, *devices.clock), devices.camera);
}

void make_pulses(const std::string& address, Devices& devices) {
  if (address.empty()) return;
  PatientLineOptions options;
  options.meanwhile =
      "The arrival of its bytes tells the receiver's time until then; it is looked for again and "
      "again.";
  const Clock& clock = *devices.clock;
  auto line = std::make_unique<PatientLine>(
      [address, &clock] { return make_pulse_per_second(address, clock); }, clock, options);
  devices.late_pulses = line.get();
  devices.pulse_per_second = std::move(line);
}

Status make_lines(const config::Config& config, Devices& devices) {
  const config::TriggerConfig& trigger = config.trigger;
  if (is_simulated(devices, trigger.line)) {
    if (!is_simulated(devices, config.camera.id)) {
      return Error{"[release] line is simulated, and the camera is not: write its line."};
    }
    devices.release = devices.bench->make_release();
  } else if (!trigger.line.empty()) {
    const ShutterWires wires{trigger.line, trigger.active_low, trigger.pulse, trigger.feedback_line,
                             trigger.feedback_active_low};
    PatientLineOptions options;
    options.has_input = !trigger.feedback_line.empty();
    options.has_output = true;
    options.meanwhile = "No photo is released until it is there; it is looked for again and again.";
    const Clock& clock = *devices.clock;
    auto line = std::make_unique<PatientLine>(
        [wires, &clock] { return make_shutter_wires(wires, clock); }, clock, options);
    devices.late_release = line.get();
    devices.release = std::move(line);
  }
  make_pulses(config.receiver.pps, devices);
  return Done{};
}

// The usual folder is made where it is missing. Another one has to be there: it may be on a disk
// that is not mounted, and the flight would be recorded on the wrong one.
Result<std::unique_ptr<Storage>> open_flights(const std::string& folder) {
  const bool is_usual = folder == config::RecordingConfig{}.folder;
  return is_usual ? open_or_make_folder(folder) : open_folder(folder);
}

Status make_devices(const config::Config& config, Devices& devices) {
  Status made = put(open_flights(config.recording.folder), devices.storage);
  if (made) made = put(make_receiver(config.receiver.address, *devices.clock), devices.receiver);
  if (made) made = make_the_camera(config, devices);
  if (made) made = make_lines(config, devices);
  if (made && !config.pilot.link.empty()) {
    made = put(make_pilot_link(config.pilot.link, config.pilot.system_id, *devices.clock),
               devices.pilot);
  }
  return made;
}

std::unique_ptr<service::CameraFinder> find_camera(const config::Config& config, const Clock& clock,
                                                   service::Daemon& daemon) {
  service::CameraFinder::Cameras cameras;
  cameras.list = [] {
    const CamerasOnBoard found = list_cameras();
    service::CamerasListed listed{{}, found.remarks};
    for (const CameraDescription& camera : found.cameras) listed.ids.push_back(camera.id);
    return listed;
  };
  cameras.make = [&clock](const std::string& id) { return make_camera(id, clock); };
  return std::make_unique<service::CameraFinder>(
      config.camera.options, clock, cameras,
      [&daemon](CameraEvent event) { daemon.hear(std::move(event)); });
}

// Of lines that were missing: their faults come as their own events.
void tell_of_returns(Devices& devices, service::Daemon& daemon) {
  const auto tell = [&daemon](const char* source) {
    daemon.note(record::Severity::kInfo, source, "It is there.");
  };
  if (devices.late_release != nullptr) {
    devices.late_release->on_return([tell] {
      tell("shutter line");
      tell("trigger line");
    });
  }
  if (devices.late_pulses != nullptr) {
    devices.late_pulses->on_return([tell] { tell("pulse per second"); });
  }
}

// Ends the daemon when SIGTERM or SIGINT comes. Made before any other thread.
class EndSignals {
 public:
  EndSignals() {
    sigemptyset(&signals_);
    for (const int number : {SIGTERM, SIGINT, SIGUSR1}) sigaddset(&signals_, number);
    ::pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
  }
  void watch(service::Daemon& daemon, const service::ServiceManager& manager) {
    thread_ = std::thread([this, &daemon, &manager] {
      int number = 0;
      do {
        ::sigwait(&signals_, &number);
        if (is_over_) return;  // the daemon may be gone, as where memory ended
      } while (number == SIGUSR1);
      if (const Status told = manager.stopping(); !told) fail(told.error().sentence);
      daemon.stop();
    });
  }
  ~EndSignals() {
    if (!thread_.joinable()) return;
    is_over_ = true;
    ::pthread_kill(thread_.native_handle(), SIGUSR1);
    thread_.join();
  }

 private:
  sigset_t signals_{};
  std::atomic<bool> is_over_ = false;
  std::thread thread_;
};

service::LifeSources sources_of(service::Daemon& daemon) {
  return {[&daemon] { return daemon.progress(); }, [&daemon] { return daemon.board().sentence(); },
          [&daemon](record::Severity severity, const std::string& source,
                    const std::string& sentence) { daemon.note(severity, source, sentence); }};
}

service::DaemonEvents events_for(Devices& devices) {
  service::DaemonEvents events;
  events.told = [](const std::string& sentence) { std::cerr << sentence + '\n'; };
  if (!devices.bench) return events;
  events.decided = [&bench = *devices.bench](const auto& decision) { bench.decided(decision); };
  events.ended = [&bench = *devices.bench](const std::string& flight) {
    if (const Status written = bench.write_truth(flight); !written) fail(written.error().sentence);
  };
  return events;
}

struct Configured {
  std::string text;
  config::Config config;
};

// Empty, with all that is wrong said, where it is not good.
std::optional<Configured> read_configuration(const std::string& path) {
  auto text = ingest::read_text_file(path);
  if (!text) {
    fail(text.error().sentence);
    return std::nullopt;
  }
  auto reading = config::parse_config(*text, path);
  for (const Error& error : reading.errors) fail(error.sentence);
  if (!reading.errors.empty()) return std::nullopt;
  return Configured{std::move(*text), std::move(reading.config)};
}

// Where there is no `plumbline config --check`.
int check(const std::string& path) {
  if (!read_configuration(path)) return kWorkFailed;
  std::cout << path << ": good\n";
  return 0;
}

int run(const std::string& path, Devices& devices) {
  const auto configured = read_configuration(path);
  if (!configured) return kWorkFailed;
  const config::Config& config = configured->config;
  const service::ServiceManager manager;
  EndSignals signals;
  if (const Status made = make_devices(config, devices); !made) return fail(made.error().sentence);
  if (const auto warning = folder_warning(config.recording.folder)) std::cerr << *warning << '\n';
  auto daemon =
      service::Daemon::start(config, configured->text, devices.lent(), events_for(devices));
  if (!daemon) return fail(daemon.error().sentence);
  // Not before: a second daemon in the same folder must not take the first one's receiver away.
  if (devices.bench) {
    if (const Status begun = devices.bench->start(); !begun) return fail(begun.error().sentence);
  }
  signals.watch(**daemon, manager);
  tell_of_returns(devices, **daemon);
  std::unique_ptr<service::CameraFinder> finder;
  if (config.camera.id.empty()) finder = find_camera(config, *devices.clock, **daemon);
  std::cerr << (*daemon)->board().sentence() + '\n';
  const service::LifeSigns life(manager, sources_of(**daemon));
  (*daemon)->run();
  finder.reset();
  return 0;
}

// After a crash in the air it is started anew at once. What refused to start is tried again too,
// for a disk may be mounted by then, but not five times a second.
int run_as_service(const std::string& path) {
  Devices devices;
  const int status = run(path, devices);
  if (status != 0 && service::ServiceManager().is_there()) std::this_thread::sleep_for(kRest);
  return status;
}

int run_at_bench(const BenchOptions& options) {
  Devices devices;
  auto bench = SimulatedBench::in(options, *devices.clock);
  if (!bench) return fail(bench.error().sentence);
  devices.bench = std::move(*bench);
  std::cerr << "A simulated flight, as " << devices.bench->configuration() << " says.\n";
  return run(devices.bench->configuration(), devices);
}

int parse_and_run(int argc, char** argv) {
  CLI::App app{"plumblined: photographs a vertical climb, and loses no photo."};
  app.name("plumblined");
  app.set_version_flag("--version", PLUMBLINE_VERSION);
  std::string config = "/etc/plumbline/plumbline.toml";
  app.add_option("--config", config, "the configuration")->capture_default_str();
  bool only_check = false;
  app.add_flag("--check", only_check, "only say what is wrong in the configuration");
  BenchOptions bench;
  CLI::Option* folder = app.add_option(
      "--bench", bench.folder,
      "fly a simulated flight in real time: with a receiver on a pseudo-terminal and, unless "
      "plumbline.toml in this folder says otherwise, a simulated camera; all is kept in it");
  app.add_option("--profile", bench.profile, "of that flight: paper, standard or ice")
      ->needs(folder)
      ->capture_default_str();
  app.add_option("--seed", bench.seed, "of that flight")->needs(folder)->capture_default_str();
  app.footer(
      "Example: plumblined --config /etc/plumbline/plumbline.toml\n"
      "         plumblined --bench bench --profile paper");
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& help) {
    return app.exit(help);
  } catch (const CLI::ParseError& wrong) {
    std::cerr << "plumblined: " << wrong.what() << "; see plumblined --help.\n";
    return kWrongUsage;
  }
  if (only_check) return check(config);
  return bench.folder.empty() ? run_as_service(config) : run_at_bench(bench);
}

}  // namespace
}  // namespace plumbline

int main(int argc, char** argv) {
  try {
    return plumbline::parse_and_run(argc, argv);
  } catch (const std::exception& broken) {  // memory
    std::fprintf(stderr, "plumblined: stopped: %s.\n", broken.what());
    return 1;
  }
}
