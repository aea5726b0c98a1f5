// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "edge/base/result.h"
#include "edge/record/entry.h"

namespace plumbline::record {

// The frames around entries: record_format.md.

inline constexpr std::uint32_t kFormatVersion = 1;

// The first bytes of every journal.
std::string journal_head();

// Appends one entry, framed, to `out`. `sequence` counts the entries of the file from 0.
void append_entry(const Entry& entry, std::uint64_t sequence, std::string& out);

enum class JournalState {
  kComplete,   // ends with Ended
  kTruncated,  // stops in the middle, as power cuts do; all that is there is good
  kDamaged     // bytes within it are not what was written
};

struct JournalSummary {
  JournalState state = JournalState::kTruncated;
  std::uint64_t entries = 0;      // good ones
  std::uint64_t unknown = 0;      // good, of a kind that a later version writes; not handed out
  std::uint64_t whole_bytes = 0;  // from the start to the end of the last entry before any damage
  std::uint64_t next_sequence = 0;
  std::uint64_t skipped_bytes = 0;  // within, not at the end
  std::uint64_t tail_bytes = 0;     // at the end, after the last good entry
  std::uint64_t lost_entries = 0;   // as their numbers tell
};

// Reads a journal's bytes entry by entry. Damage is stepped over: whatever can be read is. One
// flipped bit costs the entry it is in. Pure; never fails, ends.
class JournalReader {
 public:
  // `bytes` outlive it. Fails where they are not a journal, or one of a later format.
  static Result<JournalReader> over(std::string_view bytes);

  std::optional<Entry> next();

  // Of what was read so far; complete once next() has returned nothing.
  JournalSummary summary() const;

 private:
  struct Found {
    std::size_t begin = 0;
    std::size_t end = 0;
    std::uint64_t sequence = 0;
    std::uint16_t kind = 0;
    std::string payload;
  };

  explicit JournalReader(std::string_view bytes) : bytes_(bytes) {}
  std::optional<Found> frame_at(std::size_t place) const;
  std::optional<Found> next_frame();
  void account(const Found& found);

  std::string_view bytes_;
  std::size_t place_ = 0;
  bool ended_ = false;  // the last entry was Ended
  JournalSummary summary_;
};

}  // namespace plumbline::record
