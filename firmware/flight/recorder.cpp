// SPDX-License-Identifier: MIT
#include "firmware/flight/recorder.h"

#include <string_view>
#include <utility>

#include "edge/record/journal.h"
#include "edge/record/sha256.h"

namespace plumbline::flight {
namespace {

// Of entries, between two looks of the disk's thread.
constexpr std::size_t kHandedAtATime = 64u << 10;

std::string_view text_of(const std::vector<std::uint8_t>& bytes) {
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

// How full the memory for entries may be for this one, where `most` is what it should hold.
std::size_t most_for(const record::Entry& entry, std::size_t most) {
  constexpr std::size_t kNoLimit = static_cast<std::size_t>(-1);
  if (std::holds_alternative<record::Stored>(entry)) return kNoLimit;
  if (std::holds_alternative<record::Ended>(entry)) return kNoLimit;
  const bool is_said = std::holds_alternative<capture::Decision>(entry) ||
                       std::holds_alternative<record::Message>(entry);
  return is_said ? 2 * most : most;
}

}  // namespace

Recorder::Recorder(Storage& storage, const Clock& clock, std::optional<OpenFlight> flight,
                   const RecorderOptions& options, Sink sink)
    : storage_(storage),
      clock_(clock),
      options_(options),
      sink_(std::move(sink)),
      synced_(clock.now()) {
  handed_.reserve(kHandedAtATime);  // whoever decides does not wait for memory either
  if (!flight) return;
  folder_ = std::move(flight->folder);
  sequence_ = flight->next_sequence;
  journal_ = std::move(flight->journal);
}

void Recorder::record(const record::Entry& entry) {
  const std::lock_guard lock(mutex_);
  if (handed_.size() > most_for(entry, options_.most_waiting_bytes)) {
    ++counts_.lost_entries;
    return;
  }
  record::append_entry(entry, sequence_++, handed_);
  durable_ = false;
  ++counts_.entries;
}

void Recorder::expect_photo() {
  const std::lock_guard lock(mutex_);
  ++expected_;
}

bool Recorder::store(int number, std::vector<std::uint8_t> jpeg) {
  const std::lock_guard lock(mutex_);
  --expected_;
  if (photos_.size() >= options_.most_waiting_photos) {
    ++counts_.refused_photos;
    return false;
  }
  photos_.push_back({number, std::move(jpeg)});
  return true;
}

void Recorder::photo_failed() {
  const std::lock_guard lock(mutex_);
  --expected_;
}

void Recorder::end(const std::string& why) {
  const std::lock_guard lock(mutex_);
  if (!end_) end_ = why;
}

void Recorder::start_over() {
  const std::lock_guard lock(mutex_);
  handed_.clear();
  sequence_ = 0;
  starts_over_ = true;
}

bool Recorder::has_ended() const {
  const std::lock_guard lock(mutex_);
  return ended_;
}

std::string Recorder::folder() const {
  const std::lock_guard lock(mutex_);
  return folder_;
}

bool Recorder::open(HostTime now) {
  if (journal_) return true;
  auto flight = new_flight(storage_);
  if (!flight) {
    trouble(flight.error(), now);
    return false;
  }
  journal_ = std::move(flight->journal);
  const std::lock_guard lock(mutex_);
  folder_ = flight->folder;
  return true;
}

void Recorder::take_over() {
  const std::lock_guard lock(mutex_);
  if (std::exchange(starts_over_, false)) journal_->start_over(record::journal_head());
  if (journal_->waiting_bytes() > options_.most_waiting_bytes) return;
  journal_->append(handed_);
  handed_.clear();
}

bool Recorder::work() {
  const HostTime now = clock_.now();
  if (again_ && now < *again_) return false;
  again_.reset();
  if (!open(now)) return false;
  take_over();
  const bool stored = store_next(now);
  if (!stored && journal_->waiting_bytes() > 0 && now >= synced_ + options_.sync_every) {
    sync_journal(now);
  }
  if (!stored) end_if_done(now);
  if (in_trouble_ && !again_) {
    in_trouble_ = false;
    sink_(DiskIsBack{});
  }
  if (!in_trouble_) tell_of_lost_entries();
  const std::lock_guard lock(mutex_);
  durable_ = handed_.empty() && photos_.empty() && expected_ == 0 && journal_->waiting_bytes() == 0;
  return stored;
}

bool Recorder::is_durable() const {
  const std::lock_guard lock(mutex_);
  return durable_;
}

void Recorder::end_if_done(HostTime now) {
  {
    const std::lock_guard lock(mutex_);
    if (!end_ || expected_ > 0 || !photos_.empty()) return;
  }
  if (!std::exchange(end_is_written_, true)) {
    record(record::Ended{now, *end_});
    take_over();
  }
  if (!again_) sync_journal(now);
  const std::lock_guard lock(mutex_);
  ended_ = journal_->waiting_bytes() == 0;
}

// The photo stays first in the queue until it is durable: only this thread takes it out.
bool Recorder::store_next(HostTime now) {
  const Photo* photo = nullptr;
  {
    const std::lock_guard lock(mutex_);
    if (!photos_.empty()) photo = &photos_.front();
  }
  if (photo == nullptr) return false;
  const int number = photo->number;
  // What was decided about a photo is there before the photo: nobody finds one that tells nothing.
  sync_journal(now);
  if (again_) return false;
  Status published = publish_camera();
  if (published) published = publish_photo(*photo);
  if (!published) {
    trouble(published.error(), now);
    return false;
  }
  const std::string_view bytes = text_of(photo->jpeg);
  record(record::Stored{now, number, photo_name(number), bytes.size(), record::sha256(bytes)});
  take_over();
  {
    const std::lock_guard lock(mutex_);
    photos_.pop_front();
  }
  unreported_.push_back(number);
  sync_journal(now);
  return true;
}

// Once, before the first photo: whoever finds one finds its camera.
Status Recorder::publish_camera() {
  if (options_.camera_toml.empty() || camera_is_there_) return Done{};
  Status published = publish(storage_, folder() + "/camera.toml", options_.camera_toml);
  camera_is_there_ = published.ok();
  return published;
}

Status Recorder::publish_photo(const Photo& photo) {
  return publish(storage_, folder() + "/" + photo_name(photo.number), text_of(photo.jpeg));
}

void Recorder::sync_journal(HostTime now) {
  if (const Status synced = journal_->sync(); !synced) {
    trouble(synced.error(), now);
    return;
  }
  synced_ = now;
  for (const int number : std::exchange(unreported_, {})) {
    {
      const std::lock_guard lock(mutex_);
      ++counts_.stored;
    }
    sink_(PhotoIsStored{number});
  }
}

void Recorder::trouble(const Error& error, HostTime now) {
  again_ = now + options_.again_after;
  if (!std::exchange(in_trouble_, true)) sink_(DiskTrouble{error.sentence});
}

void Recorder::tell_of_lost_entries() {
  std::uint64_t lost = 0;
  {
    const std::lock_guard lock(mutex_);
    lost = counts_.lost_entries - std::exchange(lost_told_, counts_.lost_entries);
  }
  if (lost > 0) sink_(EntriesLost{lost});
}

HostTime Recorder::due() const {
  if (again_) return *again_;
  const std::lock_guard lock(mutex_);
  if (!journal_ || !photos_.empty() || (end_ && !ended_ && expected_ == 0)) return clock_.now();
  const bool waits = !handed_.empty() || journal_->waiting_bytes() > 0;
  return waits ? synced_ + options_.sync_every : HostTime::max();
}

RecorderCounts Recorder::counts() const {
  const std::lock_guard lock(mutex_);
  RecorderCounts counts = counts_;
  counts.waiting_photos = photos_.size();
  return counts;
}

}  // namespace plumbline::flight
