// SPDX-License-Identifier: MIT
#include "tests/contract/pilot_benches.h"

#include <stdlib.h>

#include <filesystem>

#include "drivers/mavlink/stream_pilot_link.h"
#include "drivers/posix/serial_port.h"
#include "drivers/posix/system_clock.h"
#include "drivers/posix/udp_stream.h"
#include "edge/mavlink/conversation.h"
#include "edge/mavlink/messages.h"
#include "sim/pty_port.h"
#include "sim/recording_pilot_link.h"
#include "tests/talk/pilot_talk.h"
#include "tests/talk/udp_peer.h"

namespace plumbline::contract {
namespace {

// The real driver in real time.
class RealPilotBench : public PilotBench {
 public:
  PilotLink& link() override { return *link_; }
  HostTime now() override { return clock_.now(); }
  void pass(std::chrono::nanoseconds time) override { clock_.wait(nothing_, now() + time); }

  void heartbeat(bool armed) override { send(talk::vehicle_heartbeat(armed)); }
  void attitude(int time_boot_ms, double yaw_rad) override {
    send(talk::vehicle_attitude(time_boot_ms, yaw_rad));
  }
  void position(int time_boot_ms, double relative_altitude_m) override {
    send(talk::vehicle_position(time_boot_ms, relative_altitude_m));
  }
  void ground_station() override {
    send(talk::pilot_frame({"HEARTBEAT", {{"type", 6}, {"autopilot", 8}}, ""},
                           {.system = 255, .component = 190}));
  }
  void noise() override { send("\xFD\xFE$GNGGA,and the like\r\n"); }

  std::vector<ShownText> shown() override {
    take_what_came();
    return shown_;
  }
  std::size_t heartbeats() override {
    take_what_came();
    return heartbeats_;
  }

 protected:
  virtual void send(const std::string& bytes) = 0;
  virtual std::string receive() = 0;

  void drive(std::unique_ptr<DuplexStream> stream) {
    link_ = std::make_unique<mavlink_driver::StreamPilotLink>(std::move(stream),
                                                              mavlink::make_conversation, clock_);
  }

  void take_what_came() { reader_.feed(receive()); }

  posix::SystemClock clock_;
  Signal nothing_;
  std::unique_ptr<PilotLink> link_;

 private:
  void take(const mavlink::Frame& frame) {
    if (frame.id == mavlink::kHeartbeat) ++heartbeats_;
    if (frame.id != mavlink::kStatusText) return;
    const auto text = mavlink::status_text_of(frame);
    if (text) shown_.push_back({text->severity, text->text});
  }

  std::vector<ShownText> shown_;
  std::size_t heartbeats_ = 0;
  mavlink::FrameReader reader_{[this](const mavlink::Frame& frame) { take(frame); }};
};

class PtyPilotBench : public RealPilotBench {
 public:
  PtyPilotBench() : port_(new_folder() + "/ttyPilot") {
    drive(std::make_unique<posix::SerialPort>(port_.path()));
  }
  ~PtyPilotBench() override {
    link_.reset();
    port_.pull();
    std::filesystem::remove(std::filesystem::path(port_.path()).parent_path());
  }

  void plug_in() override { ASSERT_TRUE(port_.plug_in()); }
  void pull() override { port_.pull(); }

 private:
  static std::string new_folder() {
    std::string name = (std::filesystem::temp_directory_path() / "plumbline-pty-XXXXXX").string();
    return ::mkdtemp(name.data());
  }

  void send(const std::string& bytes) override { port_.send(bytes); }
  std::string receive() override { return port_.received(); }

  sim::PtyPort port_;
};

class UdpPilotBench : public RealPilotBench {
 public:
  explicit UdpPilotBench(bool driver_speaks_first) : speaks_first_(driver_speaks_first) {
    using Role = posix::UdpStream::Role;
    if (!speaks_first_) port_ = talk::UdpPeer().port();  // one that is free
    drive(std::make_unique<posix::UdpStream>(
        speaks_first_ ? Role::kSpeaks : Role::kListens, "127.0.0.1",
        std::to_string(speaks_first_ ? vehicle_.port() : port_)));
  }
  ~UdpPilotBench() override { link_.reset(); }

  void plug_in() override { in_ = true; }
  void pull() override { in_ = false; }
  bool notices_a_pull() const override { return false; }
  bool holds_texts_back() const override { return !speaks_first_; }

 private:
  void send(const std::string& bytes) override {
    take_what_came();
    if (in_ && port_ != 0) vehicle_.send_to(port_, bytes);
  }

  std::string receive() override {
    std::string all;
    for (std::string one = next(); !one.empty(); one = next()) {
      all += one;
      if (speaks_first_) port_ = vehicle_.sender_port();
    }
    return all;
  }

  std::string next() { return vehicle_.receive(std::chrono::milliseconds(0)); }

  bool speaks_first_;
  bool in_ = false;
  talk::UdpPeer vehicle_;
  int port_ = 0;  // of the driver; 0: not known yet
};

class RecordingPilotBench : public PilotBench {
 public:
  PilotLink& link() override { return link_; }
  HostTime now() override { return clock_.now(); }
  void pass(std::chrono::nanoseconds time) override { clock_.run_until(clock_.now() + time); }

  void plug_in() override { link_.plug_in(); }
  void pull() override { link_.pull(); }

  void heartbeat(bool armed) override {
    PilotHeartbeat heartbeat;
    heartbeat.armed = armed;
    link_.hear(heartbeat);
  }
  void attitude(int time_boot_ms, double yaw_rad) override {
    link_.hear(PilotAttitude{{}, std::chrono::milliseconds(time_boot_ms), 0.0125, -0.05, yaw_rad});
  }
  void position(int time_boot_ms, double relative_altitude_m) override {
    PilotPosition position;
    position.time_boot = std::chrono::milliseconds(time_boot_ms);
    position.relative_altitude_m = relative_altitude_m;
    link_.hear(position);
  }
  void ground_station() override { link_.hear_another(); }
  void noise() override { link_.hear_noise(); }

  std::vector<ShownText> shown() override {
    std::vector<ShownText> shown;
    for (const auto& text : link_.shown()) shown.push_back({text.severity, text.text});
    return shown;
  }
  std::size_t heartbeats() override { return link_.heartbeats().size(); }

 private:
  sim::VirtualClock clock_;
  sim::RecordingPilotLink link_{clock_};
};

}  // namespace

std::unique_ptr<PilotBench> make_pty_pilot_bench() { return std::make_unique<PtyPilotBench>(); }
std::unique_ptr<PilotBench> make_listening_pilot_bench() {
  return std::make_unique<UdpPilotBench>(false);
}
std::unique_ptr<PilotBench> make_speaking_pilot_bench() {
  return std::make_unique<UdpPilotBench>(true);
}
std::unique_ptr<PilotBench> make_recording_pilot_bench() {
  return std::make_unique<RecordingPilotBench>();
}

}  // namespace plumbline::contract
