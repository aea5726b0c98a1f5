// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "drivers/clock.h"
#include "drivers/storage.h"
#include "edge/record/entry.h"
#include "firmware/flight/flight_folder.h"

namespace plumbline::flight {

struct RecorderOptions {
  std::chrono::nanoseconds sync_every = std::chrono::seconds(1);   // what is not a photo
  std::chrono::nanoseconds again_after = std::chrono::seconds(1);  // the disk refused
  std::size_t most_waiting_bytes = 8u << 20;                       // of the journal, in memory
  std::size_t most_waiting_photos = 32;
  std::string camera_toml;  // the camera as it was calibrated, beside the photos; "": not known
};

// What the recorder has to say, from the thread that works.
struct PhotoIsStored {
  int number = 0;
};
struct DiskTrouble {
  std::string sentence;
};
struct DiskIsBack {};
// The disk was so slow that memory did not hold what was to be written; photos are not among them.
struct EntriesLost {
  std::uint64_t count = 0;
};
using RecorderEvent = std::variant<PhotoIsStored, DiskTrouble, DiskIsBack, EntriesLost>;

struct RecorderCounts {
  std::uint64_t entries = 0;
  std::uint64_t lost_entries = 0;  // the memory for them was full
  std::uint64_t stored = 0;
  std::uint64_t refused_photos = 0;
  std::size_t waiting_photos = 0;
};

// Writes a flight. Whoever decides hands entries and photos over and never waits; one thread calls
// work(), where all waiting for the disk is done. The journal is synced, then a photo is published,
// then named in the journal, then that is synced, then it is reported as stored. What the disk
// refuses is kept and tried again.
class Recorder {
 public:
  using Sink = std::function<void(RecorderEvent)>;

  // `storage` and `clock` outlive it. Without a flight it makes a new one, in work().
  Recorder(Storage& storage, const Clock& clock, std::optional<OpenFlight> flight,
           const RecorderOptions& options, Sink sink);

  // From any thread; never wait for the disk. Where memory for entries is full, what devices sent
  // is lost first, and the name of a stored photo never.
  void record(const record::Entry& entry);
  // A photo will come, or not: the flight does not end before it has.
  void expect_photo();
  // False where too many wait: the photo is lost, and counted.
  bool store(int number, std::vector<std::uint8_t> jpeg);
  void photo_failed();
  // The flight is over: with this the journal ends, once every photo is on the disk.
  void end(const std::string& why);
  // Nothing has been flown: what was recorded is thrown away.
  void start_over();

  // The working thread's: does what can be done now. True if something was.
  bool work();
  // When to call work() again at the latest, if nothing is handed over; max: never.
  HostTime due() const;
  bool has_ended() const;
  bool is_durable() const;  // everything handed over, when work() last looked

  std::string folder() const;  // empty before there is one
  RecorderCounts counts() const;

 private:
  struct Photo {
    int number = 0;
    std::vector<std::uint8_t> jpeg;
  };

  bool open(HostTime now);
  void end_if_done(HostTime now);
  void take_over();
  bool store_next(HostTime now);
  Status publish_camera();
  Status publish_photo(const Photo& photo);
  void sync_journal(HostTime now);
  void trouble(const Error& error, HostTime now);
  void tell_of_lost_entries();

  Storage& storage_;
  const Clock& clock_;
  RecorderOptions options_;
  Sink sink_;

  mutable std::mutex mutex_;  // of what is handed over, and the counts
  std::string folder_;
  std::string handed_;
  bool starts_over_ = false;
  std::uint64_t sequence_ = 0;
  int expected_ = 0;
  std::optional<std::string> end_;  // why
  bool ended_ = false;
  bool durable_ = true;
  std::deque<Photo> photos_;
  RecorderCounts counts_;

  std::unique_ptr<JournalFile> journal_;  // the working thread's from here on
  HostTime synced_;
  std::vector<int> unreported_;  // durable, and not yet known to be named durably
  bool camera_is_there_ = false;
  bool end_is_written_ = false;
  std::optional<HostTime> again_;  // the disk refused: not before
  bool in_trouble_ = false;
  std::uint64_t lost_told_ = 0;
};

}  // namespace plumbline::flight
