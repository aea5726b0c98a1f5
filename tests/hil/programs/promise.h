// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

namespace plumbline::hil {

// What a file of the power cut's disk must hold: bytes that its number alone decides, so that
// whoever checks needs to know no more. At most 64 KiB, each number's different from all others.
std::string bytes_of(std::uint64_t number);

// The number that `bytes` were made from; 0 where they are not whole.
std::uint64_t number_in(const std::string& bytes);

}  // namespace plumbline::hil
