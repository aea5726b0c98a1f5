// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/storage.h"
#include "edge/base/result.h"
#include "edge/capture/inputs.h"
#include "edge/record/entry.h"
#include "firmware/flight/journal_file.h"

namespace plumbline::flight {

// A flight's folder on the disk, ready for its journal to be appended to.
struct OpenFlight {
  std::string folder;  // "0007"
  std::unique_ptr<JournalFile> journal;
  std::uint64_t next_sequence = 0;
  // How far it had come when it was last written to, where it may still be under way.
  std::optional<capture::Resumed> resumed;
  std::string boot;  // of the computer in which that was, and when it heard something last
  HostTime heard;
  std::vector<record::Stored> found;  // photos on the disk, whole, that the journal does not name
  std::vector<std::string> notes;     // sentences: what was found and mended
};

// "photos/0001.jpg", within the flight's folder.
std::string photo_name(int number);

// Opens the last flight if it was not ended, else makes a new one. A cut journal is cut to its
// whole entries; unfinished files are removed; nothing else is ever removed or written over. A
// flight that never left the ground is begun anew in its folder; where the ground was is kept.
// Fails with one sentence where the disk does not let it.
Result<OpenFlight> open_flight(Storage& storage);

// A new flight in any case.
Result<OpenFlight> new_flight(Storage& storage);

}  // namespace plumbline::flight
