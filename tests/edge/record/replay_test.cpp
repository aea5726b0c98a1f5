// SPDX-License-Identifier: MIT
// What was recorded of a flight gives its decisions again, bit for bit.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "edge/record/journal.h"
#include "tests/flights/capture_flight.h"

namespace plumbline::record {
namespace {

std::string packed(const std::vector<capture::Decision>& decisions) {
  std::string bytes;
  for (const auto& decision : decisions) append_entry(decision, 0, bytes);
  return bytes;
}

TEST(Replay, GivesTheDecisionsOfAFlightAgainBitForBit) {
  for (const auto release : {capture::Release::kPulse, capture::Release::kNearestFrame}) {
    flights::CaptureFlight flight;
    flight.path.bobs_per_s = 0.05;
    flight.options.release.release = release;
    const auto log = flights::fly(flight);
    std::string journal = journal_head();
    std::uint64_t sequence = 0;
    for (const auto& input : log.inputs) append_entry(input, sequence++, journal);
    auto reader = JournalReader::over(journal);
    ASSERT_TRUE(reader);
    capture::Decider again(flight.options);
    std::vector<capture::Decision> decisions;
    while (const auto entry = reader->next()) {
      again.take(std::get<capture::Input>(*entry), decisions);
    }
    ASSERT_FALSE(decisions.empty());
    EXPECT_EQ(packed(decisions), packed(log.decisions));
  }
}

}  // namespace
}  // namespace plumbline::record
