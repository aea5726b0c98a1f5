// SPDX-License-Identifier: MIT
#include "drivers/receiver_watch.h"

#include <algorithm>
#include <utility>

namespace plumbline {
namespace {

// Within a burst the bytes follow each other; USB adapters hold them back for up to 16 ms.
constexpr std::chrono::milliseconds kEndOfBurst{50};

constexpr std::size_t kMostPieces = 4096;

}  // namespace

ReceiverWatch::ReceiverWatch(const MakeFixDecoder& make_decoder, GnssReceiver::Sink sink)
    : sink_(std::move(sink)),
      judge_([this](ReceiverReport report) { sink_(std::move(report)); }),
      decoder_(make_decoder([this](const GnssFix& fix, ByteRange bytes) { hand_on(fix, bytes); })) {
}

void ReceiverWatch::opened(HostTime now) {
  judge_.opened(now);
  if (!std::exchange(was_open_, true)) return;
  const std::lock_guard lock(mutex_);
  ++counters_.reconnections;
}

void ReceiverWatch::absent(HostTime now, const std::string& sentence, bool again) {
  cut(now);
  judge_.absent(now, sentence, again);
}

void ReceiverWatch::cut(HostTime now) {
  now_ = now;
  decoder_->cut();
  burst_ = false;
  count();
}

void ReceiverWatch::bytes(HostTime arrival, std::string_view bytes) {
  now_ = arrival;
  bytes_ += bytes.size();
  pieces_.push_back({bytes_, arrival});
  if (pieces_.size() > kMostPieces) pieces_.pop_front();
  burst_ = true;
  judge_.bytes_came(arrival);
  sink_(ReceivedBytes{arrival, std::string(bytes)});
  decoder_->feed(bytes);
  count();
  judge_.look(arrival);
}

void ReceiverWatch::look(HostTime now) {
  now_ = now;
  if (burst_ && now >= pieces_.back().arrival + kEndOfBurst) {
    burst_ = false;
    decoder_->flush();
    count();
  }
  judge_.look(now);
}

HostTime ReceiverWatch::due(HostTime now) const {
  const HostTime judged = judge_.due(now);
  return burst_ ? std::min(judged, pieces_.back().arrival + kEndOfBurst) : judged;
}

ReceiverCounters ReceiverWatch::counters() const {
  const std::lock_guard lock(mutex_);
  return counters_;
}

void ReceiverWatch::hand_on(const GnssFix& fix, ByteRange bytes) {
  const HostTime first = arrival_of(bytes.begin);
  const HostTime last = arrival_of(bytes.end - 1);
  while (!pieces_.empty() && pieces_.front().end <= bytes.begin) pieces_.pop_front();
  judge_.epoch_came(now_, fix);
  sink_(ReceivedFix{fix, first, last});
}

// Of the oldest piece that is known, where the byte's own is too long ago.
HostTime ReceiverWatch::arrival_of(std::uint64_t byte) const {
  const auto piece =
      std::upper_bound(pieces_.begin(), pieces_.end(), byte,
                       [](std::uint64_t offset, const Piece& p) { return offset < p.end; });
  return piece == pieces_.end() ? now_ : piece->arrival;
}

void ReceiverWatch::count() {
  const DecoderCounters decoded = decoder_->counters();
  if (decoded.sentences != std::exchange(sentences_, decoded.sentences)) judge_.sentence_came(now_);
  const std::lock_guard lock(mutex_);
  counters_.bytes = decoded.bytes;
  counters_.sentences = decoded.sentences;
  counters_.bad_checksum = decoded.bad_checksum;
  counters_.malformed = decoded.malformed;
  counters_.epochs = decoded.epochs;
}

}  // namespace plumbline
