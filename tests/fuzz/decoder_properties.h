// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace plumbline::fuzz {

// Aborts, with a sentence on standard error, where gnss::make_fix_decoder breaks what it promises
// for these bytes: the same fixes in pieces of any size, nothing joined across a cut, no number
// that is none or out of its range, counters that add up, epochs within the bytes.
void check_decoder(std::string_view bytes);

}  // namespace plumbline::fuzz
