// SPDX-License-Identifier: MIT
#include "tests/firmware/flight/recorded_flight.h"

#include "edge/record/sha256.h"

namespace plumbline::flight {
namespace {

void note(const record::Entry& entry, RecordedFlight& flight) {
  if (std::holds_alternative<record::Began>(entry)) ++flight.began;
  if (const auto* stored = std::get_if<record::Stored>(&entry)) {
    EXPECT_TRUE(flight.stored.emplace(stored->number, *stored).second)
        << flight.folder << " names photo " << stored->number << " twice";
  }
  if (const auto* said = std::get_if<record::Message>(&entry)) flight.messages.push_back(*said);
  if (const auto* input = std::get_if<capture::Input>(&entry)) {
    flight.fixes += std::holds_alternative<capture::FixHeard>(input->what) ? 1 : 0;
  }
  const auto* decision = std::get_if<capture::Decision>(&entry);
  if (decision == nullptr) return;
  if (const auto* taken = std::get_if<capture::PhotoTaken>(&decision->what)) {
    EXPECT_TRUE(flight.taken.emplace(taken->number, *taken).second)
        << flight.folder << " gives the number " << taken->number << " twice";
  }
  if (const auto* missed = std::get_if<capture::PhotoMissed>(&decision->what)) {
    flight.missed.push_back(*missed);
  }
}

}  // namespace

RecordedFlight recorded_flight(Storage& disk, const std::string& folder) {
  RecordedFlight flight;
  flight.folder = folder;
  const auto bytes = disk.read(folder + "/flight.journal");
  if (!bytes) return flight;
  auto reader = record::JournalReader::over(*bytes);
  if (!reader) return flight;
  while (const auto entry = reader->next()) note(*entry, flight);
  flight.summary = reader->summary();
  return flight;
}

std::vector<RecordedFlight> recorded_flights(Storage& disk) {
  std::vector<RecordedFlight> flights;
  const auto folders = disk.list("");
  if (!folders) return flights;
  for (const std::string& folder : *folders) flights.push_back(recorded_flight(disk, folder));
  return flights;
}

testing::AssertionResult is_whole(Storage& disk, const std::string& folder,
                                  const record::Stored& stored) {
  const auto bytes = disk.read(folder + "/" + stored.name);
  if (!bytes) return testing::AssertionFailure() << bytes.error().sentence;
  if (bytes->size() != stored.length || record::sha256(*bytes) != stored.sha256) {
    return testing::AssertionFailure() << folder << "/" << stored.name << " is not what was stored";
  }
  return testing::AssertionSuccess();
}

std::vector<std::string> sentences(const RecordedFlight& flight, const std::string& source,
                                   const std::string& words) {
  std::vector<std::string> found;
  for (const auto& message : flight.messages) {
    if (message.source != source) continue;
    if (message.sentence.find(words) != std::string::npos) found.push_back(message.sentence);
  }
  return found;
}

}  // namespace plumbline::flight
