// SPDX-License-Identifier: MIT
#pragma once

#include <string_view>

namespace plumbline::fuzz {

// Aborts, with a sentence on standard error, where record breaks what it promises for these bytes:
// read as a journal, every byte is accounted for, and what was read is read again when it is
// written; read as an entry (its kind in two bytes, then its own), it is none, or it keeps its
// bytes from then on, and a journal that ends with it loses it alone by any cut.
void check_journal(std::string_view bytes);

}  // namespace plumbline::fuzz
