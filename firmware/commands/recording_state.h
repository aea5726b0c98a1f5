// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/record/journal.h"

namespace plumbline::commands {

// "complete", "truncated" or "damaged".
std::string name_of(record::JournalState state);

// In one sentence, what is not as it should be with a journal; "" where it is complete.
std::string trouble_with(const record::JournalSummary& journal);

}  // namespace plumbline::commands
