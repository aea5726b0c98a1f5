// SPDX-License-Identifier: MIT
#include "firmware/flight/session.h"

#include <algorithm>
#include <utility>

namespace plumbline::flight {
namespace {

constexpr std::chrono::milliseconds kLookForEntries{250};
constexpr std::chrono::seconds kBeforeKept{120};    // of inputs on the ground
constexpr std::chrono::milliseconds kTryEvery{50};  // whether a flight has ended
constexpr int kLastTries = 400;                     // without a photo more on the disk

bool belongs_before(const capture::Input& input) {
  return std::holds_alternative<capture::FixHeard>(input.what) ||
         std::holds_alternative<capture::PulsePerSecond>(input.what) ||
         std::holds_alternative<capture::CameraSeen>(input.what);
}

}  // namespace

Session::Session(const SessionOptions& options, Devices devices, SessionEvents events)
    : options_(options),
      devices_(devices),
      events_(std::move(events)),
      queue_(signal_),
      encoder_(options.jpeg_quality) {}

Session::~Session() {
  devices_.receiver.stop();
  if (devices_.camera != nullptr) devices_.camera->stop();
  if (devices_.release != nullptr) devices_.release->stop();
  if (devices_.pilot != nullptr) devices_.pilot->stop();
  if (devices_.pulse_per_second != nullptr) devices_.pulse_per_second->stop();
  pulse_worker_.reset();
  encode_worker_.reset();
  disk_worker_.reset();
}

Status Session::start() {
  auto flight = open_flight(devices_.storage);
  if (!flight) return flight.error();
  const OpenFlight* opened = &*flight;
  auto resumed = flight->resumed;
  const bool same_boot = !options_.boot.empty() && opened->boot == options_.boot;
  if (resumed && same_boot) resumed->last_seen = opened->heard;
  OpenFlight facts;
  facts.found = opened->found;
  facts.notes = opened->notes;
  recorder_ = make_recorder(std::move(*flight));
  begin_flight(resumed, &facts);
  if (options_.threads) start_workers();
  Status status = Done{};
  start_devices(status);
  return status;
}

void Session::start_workers() {
  encode_worker_ = std::make_unique<Worker>(
      devices_.clock,
      Worker::Work{[this] { return encoder_.work(); }, [] { return HostTime::max(); }});
  disk_worker_ = std::make_unique<Worker>(
      devices_.clock, Worker::Work{[this] { return work_disk(); },
                                   [this] {
                                     // Entries come without a word: it looks for them.
                                     return std::min(disk_due(),
                                                     devices_.clock.now() + kLookForEntries);
                                   }});
}

void Session::start_pulse_worker() {
  const auto give_one = [this] {
    if (pulses_wanted_.load() == 0) return false;
    --pulses_wanted_;
    pulse();
    return true;
  };
  pulse_worker_ = std::make_unique<Worker>(devices_.clock,
                                           Worker::Work{give_one, [] { return HostTime::max(); }});
}

void Session::start_devices(Status& status) {
  if (devices_.camera != nullptr) {
    const Status camera = devices_.camera->start(
        options_.camera, [this](CameraEvent event) { hear(std::move(event)); });
    if (!camera) status = camera;
  }
  if (devices_.pilot != nullptr) {
    const Status pilot =
        devices_.pilot->start([this](PilotEvent event) { hear(std::move(event)); });
    if (!pilot) status = pilot;
  }
  const std::unique_ptr<UrgentThread> urgent = run_urgently();
  if (options_.threads) start_pulse_worker();
  const Status receiver =
      devices_.receiver.start([this](ReceiverEvent event) { hear(std::move(event)); });
  if (!receiver) status = receiver;
  listen(devices_.release, true, status);
  listen(devices_.pulse_per_second, false, status);
}

void Session::listen(TriggerLine* line, bool is_shutter, Status& status) {
  if (line == nullptr ||
      (is_shutter && options_.capture.release.release != capture::Release::kPulse)) {
    return;
  }
  const Status listening = line->listen([this, is_shutter](LineEvent event) {
    if (is_shutter) {
      hear(ShutterLine{std::move(event)});
    } else {
      hear(PulseLine{std::move(event)});
    }
  });
  // A line without input answers by frames, or not at all.
  if (!listening && !is_shutter) status = listening;
}

std::shared_ptr<Recorder> Session::make_recorder(std::optional<OpenFlight> flight) {
  auto folder = std::make_shared<const Recorder*>(nullptr);
  auto recorder = std::make_shared<Recorder>(
      devices_.storage, devices_.clock, std::move(flight), options_.recorder,
      [this, folder](RecorderEvent event) {
        queue_.push(FromDisk{std::move(event), *folder != nullptr ? (*folder)->folder() : ""});
      });
  *folder = recorder.get();
  return recorder;
}

void Session::begin_flight(const std::optional<capture::Resumed>& resumed,
                           const OpenFlight* opened) {
  flight_begun_ = devices_.clock.now();
  recorder_->record(record::Began{options_.program, options_.configuration, options_.boot,
                                  flight_begun_, devices_.clock.wall().wall});
  loop_ = std::make_unique<CaptureLoop>(options_.capture, devices_.clock, actions());
  loop_->begin(resumed, std::exchange(before_, {}));  // which fills again meanwhile
  if (!options_.remark.empty()) say(record::Severity::kWarning, "program", options_.remark);
  if (opened == nullptr) return;
  for (record::Stored stored : opened->found) {
    stored.time = flight_begun_;
    recorder_->record(stored);
  }
  for (const std::string& note : opened->notes) say(record::Severity::kWarning, "disk", note);
}

CaptureActions Session::actions() {
  CaptureActions actions;
  actions.pulse = [this] {
    if (!options_.threads) {
      pulse();
      return;
    }
    ++pulses_wanted_;
    pulse_worker_->wake();
  };
  actions.keep = [this](int number, Frame frame) { keep(number, std::move(frame)); };
  actions.record = [this](const record::Entry& entry) {
    recorder_->record(entry);
    remember(entry);
  };
  actions.heard = [this](const capture::Input& input) { events_.heard(input); };
  actions.decided = [this](const capture::Decision& decision) { events_.decided(decision); };
  actions.said = [this](const record::Message& message) { events_.said(message); };
  return actions;
}

void Session::pulse() {
  if (devices_.release == nullptr) return;
  const auto pulsed = devices_.release->pulse();
  if (pulsed) return;
  queue_.push(record::Message{devices_.clock.now(), record::Severity::kFault, "trigger line",
                              pulsed.error().sentence});
}

void Session::keep(int number, Frame frame) {
  const std::shared_ptr<Recorder> recorder = recorder_;
  recorder->expect_photo();
  encoder_.add(std::move(frame), [this, number, recorder](auto jpeg) {
    std::string trouble;
    if (!jpeg) {
      recorder->photo_failed();
      trouble = jpeg.error().sentence;
    } else if (!recorder->store(number, std::move(jpeg).value())) {
      trouble = "too many wait for the disk; it is taken again where its height is passed again.";
    }
    if (disk_worker_) disk_worker_->wake();
    if (trouble.empty()) return;
    queue_.push(LostOnTheWay{number, recorder,
                             "Photo " + std::to_string(number) + " was lost: " + trouble});
  });
  if (encode_worker_) encode_worker_->wake();
}

void Session::remember(const record::Entry& entry) {
  const auto* input = std::get_if<capture::Input>(&entry);
  if (input == nullptr || !belongs_before(*input)) return;
  if (loop_ && loop_->decider().phase() == capture::Phase::kFlying) {
    before_.clear();
    return;
  }
  before_.push_back(*input);
  while (before_.front().now < input->now - kBeforeKept) before_.pop_front();
}

void Session::take(Event event) {
  if (auto* device = std::get_if<DeviceEvent>(&event)) {
    loop_->take(std::move(*device));
  } else if (const auto* disk = std::get_if<FromDisk>(&event)) {
    take_from_disk(*disk);
  } else if (const auto* flight = std::get_if<FlightEnded>(&event)) {
    events_.ended(flight->folder);
  } else if (const auto* lost = std::get_if<LostOnTheWay>(&event)) {
    say(record::Severity::kFault, "photo", lost->sentence);
    if (lost->flight == recorder_) loop_->lose(lost->number);
  } else {
    const auto& message = std::get<record::Message>(event);
    recorder_->record(message);
    events_.said(message);
  }
}

void Session::take_from_disk(const FromDisk& from) {
  if (const auto* stored = std::get_if<PhotoIsStored>(&from.event)) {
    events_.stored(stored->number, from.folder);
  } else if (const auto* trouble = std::get_if<DiskTrouble>(&from.event)) {
    say(record::Severity::kFault, "disk", trouble->sentence);
  } else if (const auto* lost = std::get_if<EntriesLost>(&from.event)) {
    say(record::Severity::kFault, "disk",
        std::to_string(lost->count) +
            " entries of the journal were lost while the disk took too little; no photo is among "
            "them. Use a faster disk.");
  } else {
    say(record::Severity::kInfo, "disk", "The disk takes what is written again.");
  }
}

void Session::say(record::Severity severity, const std::string& source,
                  const std::string& sentence) {
  const record::Message message{devices_.clock.now(), severity, source, sentence};
  recorder_->record(message);
  events_.said(message);
}

// Landed: the next flight begins. Long on the ground: its record begins anew.
void Session::look_after_flight() {
  if (loop_->has_landed()) {
    before_.clear();
    recorder_->end("landed");
    auto next = make_recorder(std::nullopt);
    {
      const std::lock_guard lock(recorders_mutex_);
      ending_.push_back(std::exchange(recorder_, std::move(next)));
    }
    begin_flight(std::nullopt, nullptr);
    if (disk_worker_) disk_worker_->wake();
    return;
  }
  const bool on_ground = loop_->decider().phase() != capture::Phase::kFlying;
  if (!on_ground || devices_.clock.now() - flight_begun_ < options_.ground_record) return;
  recorder_->start_over();
  begin_flight(std::nullopt, nullptr);
}

std::vector<std::shared_ptr<Recorder>> Session::recorders() const {
  const std::lock_guard lock(recorders_mutex_);
  std::vector<std::shared_ptr<Recorder>> all = ending_;
  all.push_back(recorder_);
  return all;
}

bool Session::work_disk() {
  bool more = false;
  for (const auto& recorder : recorders()) {
    more = recorder->work() || more;
    const std::lock_guard lock(recorders_mutex_);
    if (recorder == recorder_) continue;
    // After a power cut only the last folder is gone on with: the one before has to be whole.
    if (!recorder->has_ended()) break;
    std::erase(ending_, recorder);
    queue_.push(FlightEnded{recorder->folder()});
  }
  return more;
}

HostTime Session::disk_due() const {
  HostTime due = HostTime::max();
  for (const auto& recorder : recorders()) {
    due = std::min(due, recorder->due());
    if (!recorder->has_ended()) break;  // as work_disk() does: the others wait for it
  }
  return due;
}

HostTime Session::due() const {
  HostTime due = loop_->due();
  if (options_.round_every) due = std::min(due, devices_.clock.now() + *options_.round_every);
  return options_.threads ? due : std::min(due, disk_due());
}

// This thread and those that bring a fix to it and take a pulse from it: a decision is late by as
// long as encoding or measuring hold the processor. Nothing is to be hurried in a simulation.
std::unique_ptr<UrgentThread> Session::run_urgently() const {
  return options_.threads ? std::make_unique<UrgentThread>() : nullptr;
}

void Session::run(HostTime until) {
  const std::unique_ptr<UrgentThread> urgent = run_urgently();
  if (urgent && !urgent->is_allowed()) {
    say(record::Severity::kInfo, "computer",
        "Real-time priority is not allowed (LimitRTPRIO): where the processor is busy, a photo may "
        "be some milliseconds late.");
  }
  while (!stopping_ && devices_.clock.now() < until) {
    while (auto event = queue_.pop()) take(std::move(*event));
    if (devices_.clock.now() >= loop_->due()) loop_->tick();
    look_after_flight();
    if (!options_.threads) {
      while (encoder_.work()) {
      }
      while (work_disk()) {
      }
    }
    events_.lived();
    devices_.clock.wait(signal_, std::min(until, due()));
  }
}

void Session::stop() {
  stopping_ = true;
  signal_.raise();
}

void Session::note(record::Severity severity, const std::string& source,
                   const std::string& sentence) {
  queue_.push(record::Message{devices_.clock.now(), severity, source, sentence});
}

WorkAtHand Session::work_at_hand() const {
  WorkAtHand work;
  if (encode_worker_) work.encoding = encode_worker_->busy_since();
  if (disk_worker_) work.storing = disk_worker_->busy_since();
  return work;
}

std::uint64_t Session::disk_progress() const {
  std::uint64_t stored = 0;
  for (const auto& recorder : recorders()) stored += 1 + recorder->counts().stored;
  return stored;
}

void Session::finish(const std::string& why) {
  recorder_->end(why);
  wait_for_disk([this] { return recorder_->has_ended(); });
}

void Session::close() {
  if (loop_->decider().phase() == capture::Phase::kFlying) {
    wait_for_disk([this] { return recorder_->is_durable(); });
  } else {
    finish("The program was stopped.");
  }
}

void Session::wait_for_disk(const std::function<bool()>& done) {
  std::uint64_t progress = 0;  // as long as a slow disk comes on it is waited for
  for (int tries = 0; tries < kLastTries && !done(); ++tries) {
    if (const std::uint64_t now = disk_progress(); now != std::exchange(progress, now)) tries = 0;
    if (options_.threads) {
      disk_worker_->wake();
      Signal never;
      devices_.clock.wait(never, devices_.clock.now() + kTryEvery);
    } else {
      while (encoder_.work()) {
      }
      work_disk();
    }
  }
}

}  // namespace plumbline::flight
