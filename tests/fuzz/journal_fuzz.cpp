// SPDX-License-Identifier: MIT
// The entry point of libFuzzer, and of the program that runs the corpus in a normal build.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/journal_properties.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  plumbline::fuzz::check_journal({reinterpret_cast<const char*>(data), size});
  return 0;
}
