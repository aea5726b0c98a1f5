// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera.h"
#include "drivers/clock.h"
#include "drivers/event_queue.h"
#include "drivers/gnss_receiver.h"
#include "drivers/pilot_link.h"
#include "drivers/storage.h"
#include "drivers/trigger_line.h"
#include "edge/capture/capture_plan.h"
#include "firmware/flight/capture_loop.h"
#include "firmware/flight/photo_encoder.h"
#include "firmware/flight/recorder.h"
#include "firmware/flight/urgent_thread.h"
#include "firmware/flight/worker.h"

namespace plumbline::flight {

// The devices of one drone, lent. What is not there is null.
struct Devices {
  Clock& clock;
  Storage& storage;
  GnssReceiver& receiver;
  Camera* camera = nullptr;
  TriggerLine* release = nullptr;  // pulses out; its input, where it has one, is the shutter's
  TriggerLine* pulse_per_second = nullptr;
  PilotLink* pilot = nullptr;
};

struct SessionOptions {
  capture::CaptureOptions capture;
  CameraOptions camera;
  RecorderOptions recorder;
  int jpeg_quality = 92;
  std::string program = "plumblined";
  std::string configuration;  // the text, for the journal
  std::string boot;           // what tells this boot from others
  // Storing and encoding on threads of their own; a simulation does them in between.
  bool threads = true;
  std::chrono::nanoseconds ground_record = std::chrono::minutes(30);  // then it is begun anew
  std::string remark;  // a warning at the beginning of each flight's journal; "": none
  // The deciding thread lives through a round at least so often; empty: where something happens.
  std::optional<std::chrono::nanoseconds> round_every;
};

// What happens, for status, advice and measuring. On the deciding thread, in order.
struct SessionEvents {
  std::function<void(const capture::Input&)> heard = [](const auto&) {};
  std::function<void(const capture::Decision&)> decided = [](const auto&) {};
  std::function<void(const record::Message&)> said = [](const auto&) {};
  std::function<void(int number, const std::string& folder)> stored = [](int, const auto&) {};
  std::function<void(const std::string& folder)> ended = [](const auto&) {};
  std::function<void()> lived = [] {};  // through a round: nothing that was due is left
};

// Since when the threads that may take long have been at one piece of their work; empty: they wait.
struct WorkAtHand {
  std::optional<HostTime> encoding;
  std::optional<HostTime> storing;
};

// A companion computer from power on to power off: flights one after the other, each a folder. The
// deciding thread is the one that calls run().
class Session {
 public:
  Session(const SessionOptions& options, Devices devices, SessionEvents events);
  ~Session();
  Session(const Session&) = delete;
  Session& operator=(const Session&) = delete;

  // Opens or goes on with a flight, and starts the devices. Fails where waiting cannot help.
  Status start();

  // Lives until `until`, or until stop() is called from any thread.
  void run(HostTime until);
  void stop();

  // Ends the flight that is under way, and waits for the disk.
  void finish(const std::string& why);

  // The program is to end: on the ground as finish(); in the air everything is brought to the disk,
  // and the flight is left open, for the program may be started again before it lands.
  void close();

  void hear(DeviceEvent event) { queue_.push(std::move(event)); }  // from any thread
  // Said, and recorded in the flight's journal. From any thread.
  void note(record::Severity severity, const std::string& source, const std::string& sentence);
  WorkAtHand work_at_hand() const;  // from any thread, once start() is over
  const CaptureLoop& loop() const { return *loop_; }
  const Recorder& recorder() const { return *recorder_; }

 private:
  struct FromDisk {
    RecorderEvent event;
    std::string folder;
  };
  struct FlightEnded {
    std::string folder;
  };
  // Decided and exposed, and then neither encoded nor taken by the disk's queue.
  struct LostOnTheWay {
    int number = 0;
    std::shared_ptr<Recorder> flight;
    std::string sentence;
  };
  using Event = std::variant<DeviceEvent, FromDisk, FlightEnded, LostOnTheWay, record::Message>;

  void start_workers();
  void start_pulse_worker();
  std::unique_ptr<UrgentThread> run_urgently() const;
  void start_devices(Status& status);
  void listen(TriggerLine* line, bool is_shutter, Status& status);
  std::shared_ptr<Recorder> make_recorder(std::optional<OpenFlight> flight);
  void begin_flight(const std::optional<capture::Resumed>& resumed, const OpenFlight* opened);
  CaptureActions actions();
  void keep(int number, Frame frame);
  void pulse();
  void take(Event event);
  void take_from_disk(const FromDisk& from);
  void look_after_flight();
  void remember(const record::Entry& entry);
  std::vector<std::shared_ptr<Recorder>> recorders() const;
  bool work_disk();
  std::uint64_t disk_progress() const;
  void wait_for_disk(const std::function<bool()>& done);
  HostTime disk_due() const;
  HostTime due() const;
  void say(record::Severity severity, const std::string& source, const std::string& sentence);

  SessionOptions options_;
  Devices devices_;
  SessionEvents events_;
  Signal signal_;
  EventQueue<Event> queue_;
  std::atomic<bool> stopping_ = false;

  std::shared_ptr<Recorder> recorder_;             // of the flight
  mutable std::mutex recorders_mutex_;             // of the pointers
  std::vector<std::shared_ptr<Recorder>> ending_;  // of flights before, until they are on the disk
  std::unique_ptr<CaptureLoop> loop_;
  HostTime flight_begun_;
  std::deque<capture::Input> before_;  // the last inputs on the ground, for the next record
  PhotoEncoder encoder_;
  std::unique_ptr<Worker> pulse_worker_;
  std::unique_ptr<Worker> encode_worker_;
  std::unique_ptr<Worker> disk_worker_;
  std::atomic<int> pulses_wanted_ = 0;
};

}  // namespace plumbline::flight
