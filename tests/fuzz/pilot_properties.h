// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace plumbline::fuzz {

// Aborts, with a sentence on standard error, where mavlink::Conversation breaks what it promises
// for these bytes: the same messages in pieces of any size, no number that is none or out of its
// range, counters that add up, and a text of these bytes that is read as it was written.
void check_conversation(std::string_view bytes);

}  // namespace plumbline::fuzz
