// SPDX-License-Identifier: MIT
#include "drivers/gnss/stream_receiver.h"

#include <algorithm>
#include <utility>

namespace plumbline::gnss_driver {
namespace {

constexpr std::chrono::milliseconds kBetweenLooks{100};
constexpr std::chrono::seconds kLongestWait{1};

}  // namespace

StreamReceiver::StreamReceiver(std::unique_ptr<ByteStream> stream, MakeFixDecoder make_decoder,
                               const Clock& clock, StreamReceiverOptions options)
    : stream_(std::move(stream)),
      make_decoder_(std::move(make_decoder)),
      clock_(clock),
      options_(options) {}

StreamReceiver::~StreamReceiver() { StreamReceiver::stop(); }

Status StreamReceiver::start(Sink sink) {
  if (thread_.joinable()) return Error{name() + " is being read already: stop it first."};
  if (const Status speed = set_first_speed(); !speed) return speed;
  const ByteStream::Opening opening = stream_->open();
  if (opening.presence == ByteStream::Presence::kRefused) return Error{opening.sentence};
  {
    const std::lock_guard lock(watch_mutex_);
    watch_ = std::make_unique<ReceiverWatch>(make_decoder_, std::move(sink));
  }
  open_ = opening.presence == ByteStream::Presence::kOpen;
  ended_ = stopping_ = false;
  thread_ = std::thread([this, opening] {
    const HostTime now = clock_.now();
    watch_->set_name(name());
    open_ ? watch_->opened(now) : watch_->absent(now, opening.sentence);
    search_->begin(now);
    run();
  });
  return Done{};
}

// The speed that was found before is the first to be tried.
Status StreamReceiver::set_first_speed() {
  std::vector<int> speeds = stream_->speeds();
  if (speeds.empty()) {
    search_.emplace(speeds);
    return Done{};
  }
  if (options_.baud != 0) speeds.assign(1, options_.baud);
  const auto known = std::find(speeds.begin(), speeds.end(), baud_.load());
  if (known != speeds.end()) std::rotate(speeds.begin(), known, known + 1);
  baud_ = speeds.front();
  search_.emplace(speeds);
  return stream_->set_speed(baud_);
}

void StreamReceiver::stop() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  stream_->interrupt();
  thread_.join();
  stream_->close();
}

std::string StreamReceiver::name() const {
  const int baud = baud_;
  return baud == 0 ? stream_->name() : stream_->name() + " at " + std::to_string(baud) + " baud";
}

ReceiverCounters StreamReceiver::counters() const {
  const std::lock_guard lock(watch_mutex_);
  return watch_ ? watch_->counters() : ReceiverCounters{};
}

void StreamReceiver::run() {
  while (!stopping_ && !ended_) {
    open_ ? read_on() : look_for_stream();
  }
  watch_->cut(clock_.now());
}

void StreamReceiver::look_for_stream() {
  stream_->pause(kBetweenLooks);
  if (stopping_) return;
  const ByteStream::Opening opening = stream_->open();
  const HostTime now = clock_.now();
  open_ = opening.presence == ByteStream::Presence::kOpen;
  if (open_) {
    watch_->opened(now);
    search_->begin(now);
  } else {
    watch_->absent(now, opening.sentence, opening.presence == ByteStream::Presence::kRefused);
  }
}

void StreamReceiver::read_on() {
  const HostTime before = clock_.now();
  const auto wait = std::min<std::chrono::nanoseconds>(
      std::max<std::chrono::nanoseconds>(watch_->due(before) - before, {}), kLongestWait);
  const ByteStream::Reading reading = stream_->read(wait);
  const HostTime now = clock_.now();
  take(reading, now);
  if (!open_) return;
  watch_->look(now);
  change_speed_if_wrong(now);
}

void StreamReceiver::take(const ByteStream::Reading& reading, HostTime now) {
  switch (reading.arrival) {
    case ByteStream::Arrival::kBytes:
      take_bytes(reading.bytes, now);
      break;
    case ByteStream::Arrival::kNothing:
      break;
    case ByteStream::Arrival::kEnd:
      ended_ = true;
      [[fallthrough]];
    case ByteStream::Arrival::kGone:
      open_ = false;
      watch_->absent(now, reading.sentence);
  }
}

void StreamReceiver::take_bytes(std::string_view bytes, HostTime now) {
  const std::uint64_t before = watch_->counters().sentences;
  watch_->bytes(now, bytes);
  search_->bytes_came(bytes.size());
  if (watch_->counters().sentences != before) search_->sentence_came(now);
}

void StreamReceiver::change_speed_if_wrong(HostTime now) {
  const auto speed = search_->next(now);
  if (!speed) return;
  watch_->cut(now);
  if (!stream_->set_speed(*speed)) return;  // a port that has gone: the next read says so
  baud_ = *speed;
  watch_->set_name(name());
}

}  // namespace plumbline::gnss_driver
