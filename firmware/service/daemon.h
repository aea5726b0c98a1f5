// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "edge/base/result.h"
#include "firmware/config/config.h"
#include "firmware/flight/session.h"
#include "firmware/service/adviser.h"
#include "firmware/service/measurer.h"
#include "firmware/service/single_instance.h"
#include "firmware/service/status_board.h"
#include "firmware/service/status_server.h"

namespace plumbline::service {

// The daemon: a session with what stands around it. Devices are handed in.
class Daemon {
 public:
  // `text` is the configuration as it was read. Fails, with a sentence, where it cannot begin.
  static Result<std::unique_ptr<Daemon>> start(const config::Config& config,
                                               const std::string& text, flight::Devices devices);
  ~Daemon();

  // Until stop(), from any thread.
  void run();
  void stop() { session_->stop(); }

  // A camera that was found later.
  void hear(flight::DeviceEvent event) { session_->hear(std::move(event)); }
  const StatusBoard& board() const { return board_; }

 private:
  Daemon(const config::Config& config, flight::Devices devices, SingleInstance instance);

  flight::SessionEvents events();
  void look_at_space();

  config::Config config_;
  flight::Devices devices_;
  SingleInstance instance_;
  StatusBoard board_;
  std::unique_ptr<StatusServer> server_;
  std::unique_ptr<Measurer> measurer_;
  std::unique_ptr<Adviser> adviser_;
  std::unique_ptr<flight::Session> session_;
};

flight::SessionOptions session_options(const config::Config& config, const std::string& text);

}  // namespace plumbline::service
