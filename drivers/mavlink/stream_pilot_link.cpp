// SPDX-License-Identifier: MIT
#include "drivers/mavlink/stream_pilot_link.h"

#include <algorithm>
#include <chrono>
#include <utility>

namespace plumbline::mavlink_driver {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kBetweenLooks{100};
constexpr milliseconds kBetweenHeartbeats{1000};
constexpr milliseconds kLongestWait{200};
constexpr milliseconds kUntilRoom{50};  // on a line that was full
constexpr milliseconds kPause{300};     // longer than any within a message

std::uint64_t frames_of(const PilotCounters& counters) {
  return counters.frames + counters.unknown;
}

}  // namespace

StreamPilotLink::StreamPilotLink(std::unique_ptr<DuplexStream> stream,
                                 MakePilotProtocol make_protocol, const Clock& clock,
                                 StreamPilotLinkOptions options)
    : stream_(std::move(stream)),
      make_protocol_(std::move(make_protocol)),
      clock_(clock),
      options_(options) {}

StreamPilotLink::~StreamPilotLink() { StreamPilotLink::stop(); }

Status StreamPilotLink::start(Sink sink) {
  if (thread_.joinable()) return Error{name() + " is in use already: stop it first."};
  if (!stream_->speeds().empty()) {
    if (const Status speed = stream_->set_speed(options_.baud); !speed) return speed;
  }
  const ByteStream::Opening opening = stream_->open();
  if (opening.presence == ByteStream::Presence::kRefused) return Error{opening.sentence};
  sink_ = std::move(sink);
  protocol_ = make_protocol_([this](const PilotMessage& message) { take_message(message); });
  judge_ = std::make_unique<PilotJudge>(name(), [this](const PilotReport& said) { sink_(said); });
  counted_ = {};
  was_open_ = false;
  running_ = true;
  thread_ = std::thread([this, opening] {
    begin(opening);
    run();
  });
  return Done{};
}

void StreamPilotLink::stop() {
  if (!thread_.joinable()) return;
  running_ = false;
  stream_->interrupt();
  thread_.join();
  stream_->close();
  texts_.drop_all();
}

void StreamPilotLink::say(PilotSeverity severity, std::string_view text) {
  if (!running_) {
    texts_.count_dropped();
    return;
  }
  texts_.push({severity, std::string(text), clock_.now()});
  stream_->interrupt();
}

std::string StreamPilotLink::name() const {
  if (stream_->speeds().empty()) return stream_->name();
  return stream_->name() + " at " + std::to_string(options_.baud) + " baud";
}

PilotLinkCounters StreamPilotLink::counters() const {
  const std::lock_guard lock(mutex_);
  PilotLinkCounters counters = counters_;
  counters.texts_dropped = texts_.dropped();
  return counters;
}

void StreamPilotLink::run() {
  while (running_) {
    open_ ? talk() : look_for_stream();
    count();
  }
}

// What an attempt to open the stream led to.
void StreamPilotLink::begin(const ByteStream::Opening& opening) {
  const HostTime now = clock_.now();
  open_ = opening.presence == ByteStream::Presence::kOpen;
  if (!open_) {
    judge_->absent(now, opening.sentence);
    return;
  }
  if (std::exchange(was_open_, true)) ++counted_.reconnections;
  protocol_->cut();
  outgoing_ = {};
  next_heartbeat_ = last_bytes_ = now;
  judge_->opened(now);
}

void StreamPilotLink::look_for_stream() {
  stream_->pause(kBetweenLooks);
  if (running_) begin(stream_->open());
}

void StreamPilotLink::talk() {
  send_waiting(clock_.now());
  listen();
  if (open_) judge_->look(clock_.now());
}

void StreamPilotLink::listen() {
  const auto until_heartbeat = std::max<std::chrono::nanoseconds>(next_heartbeat_ - clock_.now(),
                                                                  std::chrono::nanoseconds::zero());
  const std::chrono::nanoseconds wait =
      outgoing_.bytes.empty() ? std::min<std::chrono::nanoseconds>(until_heartbeat, kLongestWait)
                              : std::chrono::nanoseconds(kUntilRoom);
  const ByteStream::Reading reading = stream_->read(wait);
  const HostTime now = clock_.now();
  switch (reading.arrival) {
    case ByteStream::Arrival::kBytes:
      take_bytes(reading.bytes, now);
      break;
    case ByteStream::Arrival::kNothing:
      if (now - last_bytes_ >= kPause) protocol_->flush();
      break;
    case ByteStream::Arrival::kGone:
    case ByteStream::Arrival::kEnd:
      open_ = false;
      judge_->absent(now, reading.sentence);
  }
}

void StreamPilotLink::take_bytes(std::string_view bytes, HostTime now) {
  last_bytes_ = now;
  judge_->bytes_came(now);
  const std::uint64_t before = frames_of(protocol_->counters());
  protocol_->feed(now, bytes);
  if (frames_of(protocol_->counters()) != before) judge_->frame_came(now);
}

void StreamPilotLink::take_message(const PilotMessage& message) {
  if (const auto* heartbeat = std::get_if<PilotHeartbeat>(&message)) {
    judge_->heartbeat_came(heartbeat->arrival);
  }
  std::visit([this](const auto& said) { sink_(said); }, message);
}

// Puts the next frame into outgoing_; false where there is none to send.
bool StreamPilotLink::next_frame(HostTime now) {
  if (!outgoing_.bytes.empty()) return true;
  if (now >= next_heartbeat_) {
    outgoing_ = {protocol_->heartbeat(), false};
    next_heartbeat_ = now + kBetweenHeartbeats;
    return true;
  }
  const auto text = texts_.pop(now);
  if (text) outgoing_ = {protocol_->text(text->severity, text->text), true};
  return text.has_value();
}

void StreamPilotLink::send_waiting(HostTime now) {
  while (next_frame(now)) {
    const std::size_t taken = stream_->write(outgoing_.bytes);
    outgoing_.bytes.erase(0, taken);
    if (!outgoing_.bytes.empty()) return;  // the line is full, or nobody is there
    ++(outgoing_.is_text ? counted_.texts_sent : counted_.heartbeats_sent);
  }
}

void StreamPilotLink::count() {
  counted_.heard = protocol_->counters();
  const std::lock_guard lock(mutex_);
  counters_ = counted_;
}

}  // namespace plumbline::mavlink_driver
