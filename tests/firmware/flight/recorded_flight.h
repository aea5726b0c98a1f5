// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

#include "drivers/storage.h"
#include "edge/record/journal.h"

namespace plumbline::flight {

// What a flight's journal tells, read to its end.
struct RecordedFlight {
  std::string folder;
  record::JournalSummary summary;
  std::map<int, capture::PhotoTaken> taken;  // by number
  std::map<int, record::Stored> stored;
  std::vector<record::Message> messages;
  std::vector<capture::PhotoMissed> missed;
  int began = 0;  // how often the program did
  int fixes = 0;
};

// Empty, with a summary of nothing, where the folder holds no journal.
RecordedFlight recorded_flight(Storage& disk, const std::string& folder);

// Every folder of the disk, in order.
std::vector<RecordedFlight> recorded_flights(Storage& disk);

// The photo is on the disk, of the length and the SHA-256 that the journal says.
testing::AssertionResult is_whole(Storage& disk, const std::string& folder,
                                  const record::Stored& stored);

// What was said by `source` that contains `words`, in order.
std::vector<std::string> sentences(const RecordedFlight& flight, const std::string& source,
                                   const std::string& words = "");

}  // namespace plumbline::flight
