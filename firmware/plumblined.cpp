// SPDX-License-Identifier: MIT
#include <pthread.h>

#include <CLI/CLI.hpp>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <exception>
#include <iostream>
#include <memory>
#include <string>
#include <thread>
#include <utility>

#include "firmware/config/config_toml.h"
#include "firmware/devices_in_sim.h"
#include "firmware/devices_on_board.h"
#include "firmware/ingest/text_file.h"
#include "firmware/service/daemon.h"

namespace plumbline {
namespace {

constexpr int kWorkFailed = 1;
constexpr int kWrongUsage = 2;

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
  if (config.camera.id.empty()) return Done{};  // any, found later
  return put(make_camera(config.camera.id, *devices.clock), devices.camera);
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
    const Status made = put(make_shutter_wires(wires, *devices.clock), devices.release);
    if (!made) return made;
  }
  if (config.receiver.pps.empty()) return Done{};
  return put(make_pulse_per_second(config.receiver.pps, *devices.clock), devices.pulse_per_second);
}

Status make_devices(const config::Config& config, Devices& devices) {
  Status made = put(open_folder(config.recording.folder), devices.storage);
  if (made) made = put(make_receiver(config.receiver.address, *devices.clock), devices.receiver);
  if (made) made = make_the_camera(config, devices);
  if (made) made = make_lines(config, devices);
  if (made && !config.pilot.link.empty()) {
    made = put(make_pilot_link(config.pilot.link, config.pilot.system_id, *devices.clock),
               devices.pilot);
  }
  return made;
}

// Looks for any camera until there is one, and has the daemon hear it.
class CameraFinder {
 public:
  CameraFinder(const CameraOptions& options, const Clock& clock, service::Daemon& daemon)
      : options_(options),
        clock_(clock),
        daemon_(daemon),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}
  ~CameraFinder() {
    thread_.request_stop();
    thread_.join();
    if (camera_) camera_->stop();
  }

 private:
  void run(const std::stop_token& stop) {
    while (!stop.stop_requested() && !find()) {
      std::this_thread::sleep_for(std::chrono::milliseconds(500));
    }
  }
  bool find() {
    for (const CameraDescription& description : list_cameras().cameras) {
      auto camera = make_camera(description.id, clock_);
      if (!camera) continue;
      const auto sink = [this](CameraEvent event) { daemon_.hear(std::move(event)); };
      if (!(*camera)->start(options_, sink)) continue;
      camera_ = std::move(camera).value();
      return true;
    }
    return false;
  }

  CameraOptions options_;
  const Clock& clock_;
  service::Daemon& daemon_;
  std::unique_ptr<Camera> camera_;
  std::jthread thread_;
};

// Ends the daemon when SIGTERM or SIGINT comes. Made before any other thread.
class EndSignals {
 public:
  EndSignals() {
    sigemptyset(&signals_);
    for (const int number : {SIGTERM, SIGINT, SIGUSR1}) sigaddset(&signals_, number);
    ::pthread_sigmask(SIG_BLOCK, &signals_, nullptr);
    std::signal(SIGPIPE, SIG_IGN);
  }
  void watch(service::Daemon& daemon) {
    thread_ = std::thread([this, &daemon] {
      int number = 0;
      ::sigwait(&signals_, &number);
      daemon.stop();
    });
  }
  ~EndSignals() {
    if (!thread_.joinable()) return;
    ::pthread_kill(thread_.native_handle(), SIGUSR1);
    thread_.join();
  }

 private:
  sigset_t signals_{};
  std::thread thread_;
};

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

int run(const std::string& path, Devices& devices) {
  const auto text = ingest::read_text_file(path);
  if (!text) return fail(text.error().sentence);
  const auto reading = config::parse_config(*text, path);
  for (const Error& error : reading.errors) std::cerr << "plumblined: " << error.sentence << '\n';
  if (!reading.errors.empty()) return kWorkFailed;
  const config::Config& config = reading.config;
  EndSignals signals;
  if (const Status made = make_devices(config, devices); !made) return fail(made.error().sentence);
  if (const auto warning = folder_warning(config.recording.folder)) std::cerr << *warning << '\n';
  auto daemon = service::Daemon::start(config, *text, devices.lent(), events_for(devices));
  if (!daemon) return fail(daemon.error().sentence);
  // Not before: a second daemon in the same folder must not take the first one's receiver away.
  if (devices.bench) {
    if (const Status begun = devices.bench->start(); !begun) return fail(begun.error().sentence);
  }
  signals.watch(**daemon);
  std::unique_ptr<CameraFinder> finder;
  if (config.camera.id.empty()) {
    finder = std::make_unique<CameraFinder>(config.camera.options, *devices.clock, **daemon);
  }
  std::cerr << (*daemon)->board().sentence() + '\n';
  (*daemon)->run();
  finder.reset();
  return 0;
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
  if (!bench.folder.empty()) return run_at_bench(bench);
  Devices devices;
  return run(config, devices);
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
