// SPDX-License-Identifier: MIT
#include "firmware/commands/recording_state.h"

#include <array>

namespace plumbline::commands {
namespace {

std::string counted(std::uint64_t count, const std::string& one, const std::string& more) {
  return std::to_string(count) + " " + (count == 1 ? one : more);
}

std::string of_cut(const record::JournalSummary& journal) {
  const std::string cut = "The recording is truncated: ";
  if (journal.entries == 0 && journal.tail_bytes == 0) {
    return cut +
           "its journal holds nothing, as when the power goes before anything is on the disk.";
  }
  const std::string stops = cut + "it stops without an end, as when the power goes";
  if (journal.tail_bytes == 0) return stops + ". All that is there is good.";
  return stops + "; " +
         counted(journal.tail_bytes, "byte of an unfinished entry follows",
                 "bytes of an unfinished entry follow") +
         ". All before that is good.";
}

}  // namespace

std::string name_of(record::JournalState state) {
  static constexpr std::array<const char*, 3> kNames = {"complete", "truncated", "damaged"};
  return kNames[static_cast<std::size_t>(state)];
}

std::string trouble_with(const record::JournalSummary& journal) {
  if (journal.state == record::JournalState::kComplete) return "";
  if (journal.state == record::JournalState::kTruncated) return of_cut(journal);
  return "The recording is damaged: " +
         counted(journal.skipped_bytes, "byte of the journal is", "bytes of the journal are") +
         " not what was written, " +
         counted(journal.lost_entries, "entry is lost.", "entries are lost.");
}

}  // namespace plumbline::commands
