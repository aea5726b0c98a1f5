// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/capture/capture_plan.h"
#include "edge/record/journal.h"
#include "firmware/ingest/gnss_log.h"

namespace plumbline::ingest {

struct FlightJournal {
  std::vector<record::Entry> entries;
  record::JournalSummary summary;
};

// "FLIGHT/flight.journal"; empty where `flight` is no folder that holds one.
std::optional<std::filesystem::path> journal_of(const std::filesystem::path& flight);

// Fails where the file cannot be read or is no journal; whatever damage there is, is stepped over.
Result<FlightJournal> read_flight_journal(const std::filesystem::path& path);

// Where the antenna was at the exposures of photos by their file names ("0001.jpg"), from all that
// the receiver said in the flight, before and after them. The receiver's latency (a pulse per
// second does without) is their common error of time.
AntennaPositions antenna_of_flight(const FlightJournal& journal,
                                   const std::vector<std::string>& photos,
                                   const capture::CaptureOptions& options);

// The vehicle's heading at the exposures of photos by their file names, as the autopilot told it
// within a second of each: radians from north, clockwise. Empty where it told none.
std::vector<std::optional<double>> headings_of_flight(const FlightJournal& journal,
                                                      const std::vector<std::string>& photos);

}  // namespace plumbline::ingest
