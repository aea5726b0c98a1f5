// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

#include "edge/base/result.h"
#include "firmware/config/config.h"
#include "firmware/flight/session.h"
#include "firmware/service/advice/adviser.h"
#include "firmware/service/disk/single_instance.h"
#include "firmware/service/disk/space_watch.h"
#include "firmware/service/life/progress.h"
#include "firmware/service/life/start_history.h"
#include "firmware/service/measuring/measurer.h"
#include "firmware/service/status/status_board.h"
#include "firmware/service/status/status_server.h"

namespace plumbline::service {

// For whoever runs it. `told`: from any thread, one at a time; the others on the deciding thread.
struct DaemonEvents {
  std::function<void(const std::string& sentence)> told = [](const auto&) {};  // for a log
  std::function<void(const capture::Decision&)> decided = [](const auto&) {};
  std::function<void(const std::string& folder)> ended = [](const auto&) {};  // a flight
};

struct DaemonOptions {
  // Storing and encoding on threads of their own. On a simulated clock they are done in between.
  bool threads = true;
};

// The daemon: a session with what stands around it. Devices are handed in.
class Daemon {
 public:
  // `text` is the configuration as it was read. Fails, with a sentence, where it cannot begin.
  // After three failures within a minute it captures, and leaves out advice and measuring.
  static Result<std::unique_ptr<Daemon>> start(const config::Config& config,
                                               const std::string& text, flight::Devices devices,
                                               DaemonEvents own = {},
                                               const DaemonOptions& options = {});
  ~Daemon();

  // Until stop(), from any thread.
  void run();
  void stop() { session_->stop(); }

  // A camera that was found later.
  void hear(flight::DeviceEvent event) { session_->hear(std::move(event)); }
  // For log, status and the flight's recording: what no device says of itself. Any thread.
  void note(record::Severity severity, const std::string& source, const std::string& sentence) {
    session_->note(severity, source, sentence);
  }
  const StatusBoard& board() const { return board_; }
  Progress::State progress() const;  // any thread

 private:
  Daemon(const config::Config& config, flight::Devices devices, SingleInstance instance,
         DaemonEvents own, const DaemonOptions& options);

  Status begin(const std::string& text);
  Result<flight::SessionOptions> options_for_session(const std::string& text) const;
  bool must_be_reduced();
  Status show_status();
  // For log and status alone.
  void say(record::Severity severity, const std::string& source, const std::string& sentence);
  void advise(AdviserOptions options);
  void remember();
  void measure();
  void show_result(const std::string& sentence);
  void look_for_flight_without_result();
  flight::SessionEvents events();
  void tell(const std::string& sentence);
  void tell(const capture::Decision& decision);
  void heard(const capture::Input& input);

  SpaceWatch::Events space_events();
  void say_to_pilot(PilotSeverity severity, const std::string& text);
  void look_at_space() { space_.look(rows_seen_); }
  void look_at_picture(int rows);

  config::Config config_;
  DaemonOptions options_;
  flight::Devices devices_;
  SingleInstance instance_;
  StartHistory starts_;
  DaemonEvents own_;
  std::mutex told_mutex_;
  StatusBoard board_;
  Progress progress_;
  std::optional<int> rows_seen_;  // of the camera's frames
  std::optional<geometry::Camera> calibrated_;
  bool calibration_misfits_ = false;
  bool flying_ = false;
  std::optional<HostTime> looked_;  // at the disk
  SpaceWatch space_;
  std::unique_ptr<StatusServer> server_;
  std::unique_ptr<Measurer> measurer_;
  std::unique_ptr<Adviser> adviser_;
  std::unique_ptr<flight::Session> session_;
};

flight::SessionOptions session_options(const config::Config& config, const std::string& text);

}  // namespace plumbline::service
