// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <mutex>
#include <string>
#include <thread>

#include "drivers/byte_stream.h"
#include "drivers/clock.h"
#include "drivers/pilot_judge.h"
#include "drivers/pilot_link.h"
#include "drivers/text_queue.h"

namespace plumbline::mavlink_driver {

struct StreamPilotLinkOptions {
  int baud = 57600;  // of a serial port: what autopilots' telemetry ports are set to
};

// An autopilot at the other end of a stream of bytes. Owns one thread, from start() to stop(). A
// stream that goes away is looked for ten times a second.
class StreamPilotLink : public PilotLink {
 public:
  // `clock` outlives it.
  StreamPilotLink(std::unique_ptr<DuplexStream> stream, MakePilotProtocol make_protocol,
                  const Clock& clock, StreamPilotLinkOptions options = {});
  ~StreamPilotLink() override;

  Status start(Sink sink) override;
  void stop() override;
  void say(PilotSeverity severity, std::string_view text) override;
  std::string name() const override;
  PilotLinkCounters counters() const override;

 private:
  // The frame that is being sent; the line may take it in pieces.
  struct Outgoing {
    std::string bytes;
    bool is_text = false;
  };

  void run();
  void begin(const ByteStream::Opening& opening);
  void look_for_stream();
  void talk();
  void listen();
  void take_bytes(std::string_view bytes, HostTime now);
  void take_message(const PilotMessage& message);
  bool next_frame(HostTime now);
  void send_waiting(HostTime now);
  void count();

  std::unique_ptr<DuplexStream> stream_;
  MakePilotProtocol make_protocol_;
  const Clock& clock_;
  StreamPilotLinkOptions options_;
  Sink sink_;
  std::unique_ptr<PilotProtocol> protocol_;
  std::unique_ptr<PilotJudge> judge_;
  TextQueue texts_;
  std::atomic<bool> running_ = false;
  bool open_ = false;
  bool was_open_ = false;
  Outgoing outgoing_;
  HostTime next_heartbeat_;
  HostTime last_bytes_;
  PilotLinkCounters counted_;  // of the thread

  mutable std::mutex mutex_;
  PilotLinkCounters counters_;  // under the mutex
  std::thread thread_;
};

}  // namespace plumbline::mavlink_driver
