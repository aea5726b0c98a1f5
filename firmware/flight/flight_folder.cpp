// SPDX-License-Identifier: MIT
#include "firmware/flight/flight_folder.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <set>
#include <span>
#include <utility>
#include <variant>

#include "edge/capture/ground.h"
#include "edge/gnss/antenna_track.h"
#include "edge/record/journal.h"
#include "edge/record/sha256.h"

namespace plumbline::flight {
namespace {

constexpr std::string_view kJournal = "/flight.journal";
constexpr std::string_view kUnfinished = ".part";

std::string four_digits(int number) {
  char text[16];
  std::snprintf(text, sizeof text, "%04d", number);
  return text;
}

// 0 where the name is no number.
int number_of(std::string_view name) {
  int number = 0;
  const auto read = std::from_chars(name.data(), name.data() + name.size(), number);
  return read.ec == std::errc{} && read.ptr == name.data() + name.size() ? number : 0;
}

Result<int> last_flight(Storage& storage) {
  const auto names = storage.list("");
  if (!names) return names.error();
  int last = 0;
  for (const std::string& name : *names) last = std::max(last, number_of(name));
  return last;
}

// What a journal tells of how far its flight had come.
struct Story {
  record::JournalSummary summary;
  std::uint64_t next_sequence = 0;  // after the whole entries
  std::string beyond;               // the bytes after them
  bool ended = false;
  bool flying = false;
  std::optional<double> ground_height_m;  // of the take-off point
  capture::Ground ground;                 // before it was one
  std::optional<UtcTime> last_fix;
  std::string boot;  // in which it was written last,
  HostTime heard;    // and until when
  int photos = 0;
  std::size_t heights = 0;                 // entries of the plan that photos name
  std::vector<std::pair<int, int>> taken;  // number of the photo, entry of the plan
  std::set<int> stored;
};

void read_decision(const capture::Decision& decision, Story& story) {
  if (const auto* changed = std::get_if<capture::PhaseChanged>(&decision.what)) {
    if (changed->phase == capture::Phase::kFlying) story.flying = true;
    if (changed->ground_height_m) story.ground_height_m = changed->ground_height_m;
  } else if (const auto* ground = std::get_if<capture::GroundFound>(&decision.what)) {
    story.ground_height_m = ground->ground_height_m;
  } else if (const auto* pulse = std::get_if<capture::Pulse>(&decision.what)) {
    story.photos = std::max(story.photos, pulse->number);
  } else if (const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what)) {
    story.photos = std::max(story.photos, taken->number);
    if (taken->target.entry >= 0) story.taken.emplace_back(taken->number, taken->target.entry);
  }
}

void read_fix(const GnssFix& fix, HostTime now, Story& story) {
  if (fix.time) story.last_fix = fix.time;
  if (!gnss::is_position(fix)) return;
  const double sigma_m = fix.covariance_enu_m2 ? std::sqrt((*fix.covariance_enu_m2)(2, 2))
                                               : gnss::usual_sigma_enu_m(fix.quality).z();
  story.ground.add({now, *fix.height_ellipsoidal_m, sigma_m, 0});
}

void read_entry(const record::Entry& entry, Story& story) {
  story.ended = std::holds_alternative<record::Ended>(entry);
  if (const auto* began = std::get_if<record::Began>(&entry)) {
    story.boot = began->boot;
  } else if (const auto* decision = std::get_if<capture::Decision>(&entry)) {
    read_decision(*decision, story);
  } else if (const auto* stored = std::get_if<record::Stored>(&entry)) {
    story.stored.insert(stored->number);
    story.photos = std::max(story.photos, stored->number);
  } else if (const auto* input = std::get_if<capture::Input>(&entry)) {
    story.heard = input->now;
    if (const auto* heard = std::get_if<capture::FixHeard>(&input->what)) {
      read_fix(heard->fix, input->now, story);
    }
  }
}

Result<Story> read_story(Storage& storage, const std::string& path) {
  const auto bytes = storage.read(path);
  if (!bytes) return bytes.error();
  auto reader = record::JournalReader::over(*bytes);
  if (!reader) return Error{path + ": " + reader.error().sentence};
  Story story;
  // What lies beyond damage is left alone by whoever writes on: it does not count here.
  while (const auto entry = reader->next()) {
    if (reader->summary().skipped_bytes > 0) break;
    read_entry(*entry, story);
    story.next_sequence = reader->summary().next_sequence;
  }
  while (reader->next()) {
  }
  story.summary = reader->summary();
  story.beyond = bytes->substr(story.summary.whole_bytes);
  if (story.summary.skipped_bytes > 0) story.ended = false;
  return story;
}

capture::Resumed resumed_from(const Story& story) {
  capture::Resumed resumed;
  resumed.flying = true;
  resumed.ground_height_m = *story.ground_height_m;
  resumed.last_fix = story.last_fix;
  resumed.photos = story.photos;
  for (const auto& [number, entry] : story.taken) {
    if (!story.stored.contains(number)) continue;
    const auto place = static_cast<std::size_t>(entry);
    if (place >= resumed.taken.size()) resumed.taken.resize(place + 1, 0);
    resumed.taken[place] = 1;
  }
  return resumed;
}

// A drone that is not known to have taken off may have done so since.
std::optional<capture::Resumed> ground_from(const Story& story) {
  if (!story.ground.height_m()) return std::nullopt;
  capture::Resumed resumed;
  resumed.flying = false;
  resumed.ground_height_m = *story.ground.height_m();
  resumed.last_fix = story.last_fix;
  return resumed;
}

// Whole photos that the journal does not name: power went between the two.
Status find_photos(Storage& storage, const std::string& folder, Story& story, OpenFlight& flight) {
  const std::string photos = folder + "/photos";
  const auto names = storage.list(photos);
  if (!names) return Done{};  // none was ever taken
  for (const std::string& name : *names) {
    std::string path = photos;
    path.append("/").append(name);
    if (name.ends_with(kUnfinished)) {
      if (const Status removed = storage.remove(path); !removed) return removed;
      flight.notes.push_back(path + " was unfinished when the power went, and was removed.");
      continue;
    }
    const int number = number_of(std::string_view(name).substr(0, name.find('.')));
    if (number == 0 || story.stored.contains(number)) continue;
    const auto bytes = storage.read(path);
    if (!bytes) return bytes.error();
    record::Stored stored{HostTime{}, number, "photos/" + name, bytes->size(),
                          record::sha256(*bytes)};
    flight.found.push_back(std::move(stored));
    story.stored.insert(number);
    story.photos = std::max(story.photos, number);
  }
  return Done{};
}

// Cuts a journal to its whole entries.
Status mend(Storage& storage, const std::string& path, const Story& story, OpenFlight& flight) {
  if (story.beyond.empty()) return Done{};
  // Entries beyond damage are kept aside: they may be all that is known of something.
  if (story.summary.skipped_bytes > 0) {
    const std::string aside = path + "." + std::to_string(story.summary.whole_bytes);
    if (const Status kept = publish(storage, aside, story.beyond); !kept) return kept;
    flight.notes.push_back(path + " was damaged; what follows the damage is in " + aside + ".");
  }
  if (const Status cut = storage.truncate(path, story.summary.whole_bytes); !cut) return cut;
  flight.notes.push_back(path + " did not end with a whole entry, and was cut by " +
                         std::to_string(story.beyond.size()) + " bytes.");
  return Done{};
}

Result<OpenFlight> start_in(Storage& storage, const std::string& folder) {
  for (const std::string& path : {folder, folder + "/photos"}) {
    if (const Status made = storage.make_folder(path); !made) return made.error();
  }
  OpenFlight flight;
  flight.folder = folder;
  const std::string path = folder + std::string(kJournal);
  flight.journal = std::make_unique<JournalFile>(storage, path, 0);
  flight.journal->append(record::journal_head());
  if (const Status synced = flight.journal->sync(); !synced) return synced.error();
  for (const std::string& changed : {folder, std::string()}) {
    if (const Status synced = storage.sync_folder(changed); !synced) return synced.error();
  }
  return flight;
}

Result<OpenFlight> start_over(Storage& storage, const std::string& folder, const Story& story) {
  const std::string path = folder + std::string(kJournal);
  if (const Status removed = storage.remove(path); !removed) return removed.error();
  auto flight = start_in(storage, folder);
  if (flight) flight->resumed = ground_from(story);
  return flight;
}

// The disk refused in the middle of making it, or power went.
bool holds_nothing(Storage& storage, const std::string& folder) {
  const auto photos = storage.list(folder + "/photos");
  if (photos && !photos->empty()) return false;
  const auto names = storage.list(folder);
  if (!names) return false;
  const bool has_journal =
      std::find(names->begin(), names->end(), kJournal.substr(1)) != names->end();
  if (!has_journal) return true;
  const auto journal = storage.read(folder + std::string(kJournal));
  return journal && journal->size() < record::journal_head().size();
}

Result<OpenFlight> go_on(Storage& storage, const std::string& folder, Story story) {
  OpenFlight flight;
  flight.folder = folder;
  const std::string path = folder + std::string(kJournal);
  if (const Status mended = mend(storage, path, story, flight); !mended) {
    return mended.error();
  }
  if (const Status found = find_photos(storage, folder, story, flight); !found) {
    return found.error();
  }
  flight.resumed = resumed_from(story);
  flight.journal = std::make_unique<JournalFile>(storage, path, story.summary.whole_bytes);
  flight.next_sequence = story.next_sequence;
  flight.boot = story.boot;
  flight.heard = story.heard;
  return flight;
}

}  // namespace

std::string photo_name(int number) { return "photos/" + four_digits(number) + ".jpg"; }

Result<OpenFlight> new_flight(Storage& storage) {
  const auto last = last_flight(storage);
  if (!last) return last.error();
  const std::string newest = four_digits(*last);
  if (*last == 0 || !holds_nothing(storage, newest)) {
    return start_in(storage, four_digits(*last + 1));
  }
  const Status gone = storage.remove(newest + std::string(kJournal));  // mostly there is none
  return start_in(storage, newest);
}

Result<OpenFlight> open_flight(Storage& storage) {
  const auto last = last_flight(storage);
  if (!last) return last.error();
  if (*last == 0) return start_in(storage, four_digits(1));
  const std::string folder = four_digits(*last);
  auto story = read_story(storage, folder + std::string(kJournal));
  if (!story || story->ended) return new_flight(storage);
  const auto photos = storage.list(folder + "/photos");
  const bool no_photos = !photos || photos->empty();
  if (!story->flying && no_photos) return start_over(storage, folder, *story);
  // Without the ground its heights mean nothing, and its photos must not be taken again.
  if (story->summary.whole_bytes == 0 || !story->ground_height_m) {
    return start_in(storage, four_digits(*last + 1));
  }
  return go_on(storage, folder, std::move(*story));
}

}  // namespace plumbline::flight
