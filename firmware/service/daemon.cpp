// SPDX-License-Identifier: MIT
#include "firmware/service/daemon.h"

#include <chrono>
#include <cstdio>
#include <fstream>
#include <utility>

#include "firmware/ingest/text_file.h"
#include "firmware/service/advice/calibration_size.h"

namespace plumbline::service {
namespace {

constexpr std::chrono::seconds kLookAtDiskEvery{10};
constexpr std::chrono::milliseconds kRoundEvery{500};  // also while nothing happens: it is a sign
constexpr const char* kReduced =
    "It failed three times within a minute, and goes on with photos and recording alone, without "
    "advice and measuring, until it is stopped and started by hand.";

// Tells this boot of the machine from others: host times compare within one.
std::string boot_id() {
  std::ifstream file("/proc/sys/kernel/random/boot_id");
  std::string id;
  std::getline(file, id);
  return id;
}

bool needs_frames(const config::Config& config) {
  return config.capture.release.release == capture::Release::kNearestFrame;
}

}  // namespace

flight::SessionOptions session_options(const config::Config& config, const std::string& text) {
  flight::SessionOptions options;
  options.capture = config.capture;
  options.camera = config.camera.options;
  options.jpeg_quality = config.camera.jpeg_quality;
  options.configuration = text;
  options.boot = boot_id();
  return options;
}

Daemon::Daemon(const config::Config& config, flight::Devices devices, SingleInstance instance,
               DaemonEvents own, const DaemonOptions& options)
    : config_(config),
      options_(options),
      devices_(devices),
      instance_(std::move(instance)),
      starts_(config.status.file + ".starts", boot_id()),
      own_(std::move(own)),
      board_(needs_frames(config), config.capture.take_off),
      progress_({.needs_frames = needs_frames(config)}),
      space_(config_, devices_.storage, space_events()) {}

Daemon::~Daemon() {
  session_.reset();  // its events reach the others
  measurer_.reset();
  adviser_.reset();
  board_.stopped();
}

Result<std::unique_ptr<Daemon>> Daemon::start(const config::Config& config, const std::string& text,
                                              flight::Devices devices, DaemonEvents own,
                                              const DaemonOptions& options) {
  auto instance = SingleInstance::in(config.recording.folder);
  if (!instance) return instance.error();
  std::unique_ptr<Daemon> daemon(
      new Daemon(config, devices, std::move(*instance), std::move(own), options));
  const Status begun = daemon->begin(text);
  if (begun) return daemon;
  daemon->starts_.end_well();  // a refusal, which leaving something out would not help
  return begun.error();
}

Status Daemon::begin(const std::string& text) {
  auto advice = adviser_options(config_);
  if (!advice) return advice.error();
  auto options = options_for_session(text);
  if (!options) return options.error();
  if (must_be_reduced()) {
    config_.advice.enabled = config_.measure.enabled = false;
    options->remark = kReduced;
  }
  if (const Status shown = show_status(); !shown) return shown;
  if (!config_.camera.calibration.empty()) calibrated_ = advice->plan.camera;
  if (config_.advice.enabled) advise(std::move(*advice));
  if (config_.measure.enabled) measure();
  session_ = std::make_unique<flight::Session>(*options, devices_, events());
  if (const Status started = session_->start(); !started) return started;
  if (adviser_) remember();
  look_at_space();
  look_for_flight_without_result();
  return Done{};
}

bool Daemon::must_be_reduced() {
  return starts_.begin(devices_.clock.now()) >= StartHistory::kMany;
}

Result<flight::SessionOptions> Daemon::options_for_session(const std::string& text) const {
  flight::SessionOptions options = session_options(config_, text);
  options.round_every = kRoundEvery;
  options.threads = options_.threads;
  if (config_.camera.calibration.empty()) return options;
  auto calibration = ingest::read_text_file(config_.camera.calibration);
  if (!calibration) return calibration.error();
  options.recorder.camera_toml = std::move(*calibration);
  return options;
}

Status Daemon::show_status() {
  auto server = StatusServer::start(
      board_, config_.status.socket, config_.status.file,
      [this](bool good, const std::string& sentence) {
        say(good ? record::Severity::kInfo : record::Severity::kWarning, "status", sentence);
      });
  if (!server) return server.error();
  server_ = std::move(*server);
  return Done{};
}

Progress::State Daemon::progress() const {
  return progress_.state(devices_.clock.now(), session_->work_at_hand());
}

void Daemon::look_for_flight_without_result() {
  if (!measurer_) return;
  const auto found = newest_flight(config_.recording.folder, MeasurerOptions().first_at);
  if (found) measurer_->found(*found, found->flight == session_->recorder().folder());
}

void Daemon::advise(AdviserOptions options) {
  adviser_ = std::make_unique<Adviser>(std::move(options), [this](const Advice& advice) {
    board_.advised(advice.sentence);
    tell(advice.sentence);
    say_to_pilot(PilotSeverity::kInfo, advice.short_text);
  });
}

// What was photographed before the program was started anew in the air.
void Daemon::remember() {
  adviser_->remember(
      photos_before(devices_.storage, session_->recorder().folder(), config_.capture));
}

void Daemon::measure() {
  MeasurerOptions options;
  options.flights = config_.recording.folder;
  options.memory_mb = config_.measure.memory_mb;
  options.longest = config_.measure.longest;
  if (config_.measure.command == "request") {
    options.request_file = config_.recording.folder + "/measure.request";
  } else {
    options.program = config_.measure.command;
  }
  Measurer::Events events;
  events.failed = events.begun = [this](const std::string& flight, const std::string& sentence) {
    show_result("Flight " + flight + ": " + sentence);
  };
  events.measured = [this](const Measurer::Measured& measured) {
    const std::string figures = measured.figures ? " " + in_words(*measured.figures) : "";
    show_result("Flight " + measured.flight + ": " + measured.sentence + figures);
    if (!measured.figures || measured.was_left) return;
    say_to_pilot(PilotSeverity::kInfo, for_the_pilot(*measured.figures));
  };
  measurer_ = std::make_unique<Measurer>(options, std::move(events));
}

void Daemon::show_result(const std::string& sentence) {
  board_.measured(sentence);
  tell(sentence);
}

void Daemon::say(record::Severity severity, const std::string& source,
                 const std::string& sentence) {
  board_.said({devices_.clock.now(), severity, source, sentence});
  tell(source + ": " + sentence);
}

void Daemon::tell(const std::string& sentence) {
  const std::lock_guard lock(told_mutex_);
  own_.told(sentence);
}

void Daemon::tell(const capture::Decision& decision) {
  if (const auto* missed = std::get_if<capture::PhotoMissed>(&decision.what)) {
    if (missed->number > 0) tell("Photo " + std::to_string(missed->number) + " did not come.");
  } else if (const auto* passed = std::get_if<capture::HeightPassed>(&decision.what)) {
    char height[32];
    std::snprintf(height, sizeof height, "%g m", passed->target.height_m);
    tell(std::string("No photo at ") + height + ": it was left behind; fly there again.");
    say_to_pilot(PilotSeverity::kWarning,
                 std::string("No photo at ") + height + ": fly there again");
  } else if (std::holds_alternative<capture::PhaseChanged>(decision.what)) {
    tell(board_.sentence());
  }
}

flight::SessionEvents Daemon::events() {
  flight::SessionEvents events;
  events.heard = [this](const capture::Input& input) { heard(input); };
  events.lived = [this] { progress_.lived(); };
  events.decided = [this](const capture::Decision& decision) {
    if (const auto* phase = std::get_if<capture::PhaseChanged>(&decision.what)) {
      flying_ = phase->phase == capture::Phase::kFlying;
    }
    board_.decided(decision);
    tell(decision);
    own_.decided(decision);
    if (adviser_) adviser_->decided(decision, session_->loop().decider().navigator().frame());
  };
  events.said = [this](const record::Message& message) {
    board_.said(message);
    tell(message.source + ": " + message.sentence);
  };
  events.stored = [this](int number, const std::string& folder) {
    board_.stored(number, folder);
    tell("Photo " + std::to_string(number) + " is stored in " + folder + ".");
    if (measurer_) measurer_->stored(folder);
  };
  events.ended = [this](const std::string& folder) {
    board_.ended(folder);
    own_.ended(folder);
    space_.tell_anew();
    if (!flying_) look_at_space();
    if (measurer_) measurer_->ended(folder);
  };
  return events;
}

// In flight this thread leaves the disk alone.
void Daemon::heard(const capture::Input& input) {
  board_.heard(input);
  progress_.heard(input);
  bool is_due = !looked_ || input.now >= *looked_ + kLookAtDiskEvery;
  if (const auto* frame = std::get_if<capture::FrameSeen>(&input.what)) {
    const bool tells = frame->rows > 1;  // else the camera keeps its pictures
    if (tells && std::exchange(rows_seen_, frame->rows) != frame->rows) {
      is_due = true;
      look_at_picture(frame->rows);
    }
  } else if (std::holds_alternative<capture::PilotSeen>(input.what)) {
    is_due = true;  // an autopilot that was not there before, or is armed now
    space_.tell_anew();
  }
  if (!is_due || flying_) return;
  looked_ = input.now;
  look_at_space();
}

SpaceWatch::Events Daemon::space_events() {
  SpaceWatch::Events events;
  events.found = [this](std::int64_t free_photos, std::int64_t planned) {
    board_.space(free_photos, planned);
  };
  events.told = [this](const std::string& sentence) { tell(sentence); };
  events.lacks = [this](const std::string& text) { say_to_pilot(PilotSeverity::kWarning, text); };
  return events;
}

void Daemon::say_to_pilot(PilotSeverity severity, const std::string& text) {
  if (devices_.pilot != nullptr) devices_.pilot->say(severity, text);
}

void Daemon::look_at_picture(int rows) {
  if (!calibrated_) return;
  const auto other = other_size(config_.camera, *calibrated_, rows);
  const bool was_other = std::exchange(calibration_misfits_, other.has_value());
  if (!other) {
    if (was_other) note(record::Severity::kInfo, "calibration", "It is for pictures of this size.");
    return;
  }
  note(record::Severity::kWarning, "calibration", *other);
  say_to_pilot(PilotSeverity::kWarning, "Calibration is for another picture size");
}

void Daemon::run() {
  session_->run(HostTime::max());
  session_->close();
  starts_.end_well();
}

}  // namespace plumbline::service
