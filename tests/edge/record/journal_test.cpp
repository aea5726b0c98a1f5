// SPDX-License-Identifier: MIT
#include "edge/record/journal.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "tests/flights/capture_flight.h"

namespace plumbline::record {
namespace {

using std::chrono::milliseconds;

std::string packed(const Entry& entry) {
  std::string bytes;
  pack(entry, bytes);
  return bytes;
}

std::vector<Entry> small_flight() {
  Stored stored{HostTime(milliseconds(31)), 1, "photos/0001.jpg", 4711, {}};
  stored.sha256[3] = 0xAB;
  return {Began{"plumblined 0.1", "[capture]\n", "boot", HostTime(milliseconds(1)), WallTime{}},
          Bytes{HostTime(milliseconds(20)), std::string("$GPGGA\0,\r\n", 10)},
          capture::Input{HostTime(milliseconds(30)), capture::Tick{}},
          stored,
          Message{HostTime(milliseconds(40)), Severity::kFault, "disk", "It is full."},
          Ended{HostTime(milliseconds(50)), "landed"}};
}

std::string journal_of(const std::vector<Entry>& entries) {
  std::string bytes = journal_head();
  std::uint64_t sequence = 0;
  for (const Entry& entry : entries) append_entry(entry, sequence++, bytes);
  return bytes;
}

struct ReadBack {
  std::vector<Entry> entries;
  JournalSummary summary;
};

ReadBack read_back(const std::string& bytes) {
  auto reader = JournalReader::over(bytes);
  ReadBack back;
  if (!reader) return back;
  while (auto entry = reader->next()) back.entries.push_back(std::move(*entry));
  back.summary = reader->summary();
  return back;
}

// Entries have no comparison of their own: their bytes are all of them.
bool holds_in_order(const std::vector<Entry>& some, const std::vector<Entry>& all) {
  std::size_t at = 0;
  for (const Entry& entry : some) {
    while (at < all.size() && packed(all[at]) != packed(entry)) ++at;
    if (at++ == all.size()) return false;
  }
  return true;
}

TEST(Journal, GivesBackEveryEntryOfAFlight) {
  flights::CaptureFlight flight;
  flight.path.top_m = 42;
  const auto log = flights::fly(flight);
  std::vector<Entry> entries(log.inputs.begin(), log.inputs.end());
  entries.insert(entries.end(), log.decisions.begin(), log.decisions.end());
  const ReadBack back = read_back(journal_of(entries));
  ASSERT_EQ(back.entries.size(), entries.size());
  EXPECT_TRUE(holds_in_order(back.entries, entries));
}

TEST(Journal, IsCompleteWhenItEndsWithTheEnd) {
  const ReadBack back = read_back(journal_of(small_flight()));
  EXPECT_EQ(back.summary.state, JournalState::kComplete);
  EXPECT_EQ(back.entries.size(), small_flight().size());
}

TEST(Journal, IsTruncatedWhereverItIsCut) {
  const std::string whole = journal_of(small_flight());
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const ReadBack back = read_back(whole.substr(0, size));
    EXPECT_EQ(back.summary.state, JournalState::kTruncated) << size;
    EXPECT_LE(back.summary.whole_bytes, size);
    EXPECT_TRUE(holds_in_order(back.entries, small_flight()));
  }
}

TEST(Journal, LosesOneEntryByOneFlippedBit) {
  const std::string whole = journal_of(small_flight());
  for (std::size_t bit = 16 * 8; bit < whole.size() * 8; ++bit) {
    std::string flipped = whole;
    flipped[bit / 8] = static_cast<char>(flipped[bit / 8] ^ (1 << (bit % 8)));
    const ReadBack back = read_back(flipped);
    EXPECT_EQ(back.entries.size(), small_flight().size() - 1) << bit;
    EXPECT_TRUE(holds_in_order(back.entries, small_flight())) << bit;
    EXPECT_NE(back.summary.state, JournalState::kComplete) << bit;
  }
}

// A device may send anything, a journal too.
std::vector<Entry> flight_that_hears_a_journal() {
  std::vector<Entry> entries = small_flight();
  entries[1] = Bytes{HostTime(milliseconds(20)), journal_of(small_flight())};
  entries[4] = Message{HostTime(milliseconds(40)), Severity::kInfo, "mark", "\xE7\xB5\x50"};
  return entries;
}

TEST(Journal, GivesBackAJournalThatADeviceSent) {
  const std::vector<Entry> entries = flight_that_hears_a_journal();
  const ReadBack back = read_back(journal_of(entries));
  EXPECT_EQ(back.summary.state, JournalState::kComplete);
  ASSERT_EQ(back.entries.size(), entries.size());
  EXPECT_TRUE(holds_in_order(back.entries, entries));
}

TEST(Journal, NeverTakesAJournalThatADeviceSentForItself) {
  const std::vector<Entry> entries = flight_that_hears_a_journal();
  const std::string whole = journal_of(entries);
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const ReadBack back = read_back(whole.substr(0, size));
    EXPECT_EQ(back.summary.state, JournalState::kTruncated) << size;
    EXPECT_TRUE(holds_in_order(back.entries, entries)) << size;
  }
  for (std::size_t byte = 16; byte < whole.size(); ++byte) {
    std::string bent = whole;
    bent[byte] = static_cast<char>(bent[byte] ^ 1);
    const ReadBack back = read_back(bent);
    EXPECT_EQ(back.entries.size(), entries.size() - 1) << byte;
    EXPECT_TRUE(holds_in_order(back.entries, entries)) << byte;
  }
}

TEST(Journal, IsDamagedWhereEntriesAreMissingWithin) {
  std::vector<Entry> entries = small_flight();
  std::string bytes = journal_head();
  append_entry(entries[0], 0, bytes);
  append_entry(entries[5], 2, bytes);
  const ReadBack back = read_back(bytes);
  EXPECT_EQ(back.summary.state, JournalState::kDamaged);
  EXPECT_EQ(back.summary.lost_entries, 1u);
}

// CRC-32 of the twelve bytes, by Python's zlib.
TEST(Journal, BeginsWithAHeadThatIsChecked) {
  using namespace std::string_literals;
  EXPECT_EQ(journal_head(), "PLUMBJRN\x01\0\0\0"s + "\x01\x79\xE6\x7E"s);
  const auto later = JournalReader::over("PLUMBJRN\x02\0\0\0"s + "\xEF\xD6\x53\x6C"s);
  ASSERT_FALSE(later);
  EXPECT_NE(later.error().sentence.find("of format 2"), std::string::npos);
}

TEST(Journal, SaysWhatIsNone) { EXPECT_FALSE(JournalReader::over("JFIF")); }

// What follows a head with a flipped bit is read all the same.
TEST(Journal, ReadsWhatFollowsADamagedHead) {
  const std::string head = journal_head();
  for (std::size_t byte = 8; byte < head.size(); ++byte) {
    std::string journal = head;
    append_entry(Ended{HostTime{}, "landed"}, 0, journal);
    journal[byte] = static_cast<char>(journal[byte] ^ 1);
    auto reader = JournalReader::over(journal);
    ASSERT_TRUE(reader) << byte;
    EXPECT_TRUE(reader->next()) << byte;
    EXPECT_FALSE(reader->next());
    EXPECT_EQ(reader->summary().state, JournalState::kDamaged) << byte;
  }
}

// The first programs wrote no CRC there.
TEST(Journal, TakesAHeadWithoutACrc) {
  std::string journal = journal_head();
  for (std::size_t byte = 12; byte < 16; ++byte) journal[byte] = 0;
  append_entry(Ended{HostTime{}, "landed"}, 0, journal);
  auto reader = JournalReader::over(journal);
  ASSERT_TRUE(reader);
  EXPECT_TRUE(reader->next());
  EXPECT_FALSE(reader->next());
  EXPECT_EQ(reader->summary().state, JournalState::kComplete);
}

TEST(Journal, StepsOverKindsOfALaterVersion) {
  EXPECT_FALSE(unpack(999, ""));
  EXPECT_FALSE(unpack(40, "short"));
}

}  // namespace
}  // namespace plumbline::record
