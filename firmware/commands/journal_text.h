// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/record/entry.h"

namespace plumbline::commands {

// One line of text for one entry of a journal: host seconds, kind, and what it holds, each as
// name=value. Bytes of the receiver are shown with \xHH for what is no printable ASCII.
std::string text_of(const record::Entry& entry);

// "height", "aside", ...; "waiting", ...
std::string name_of(capture::Reason reason);
std::string name_of(capture::Phase phase);

}  // namespace plumbline::commands
