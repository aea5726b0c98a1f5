// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string_view>

namespace plumbline::flight {

// SHA-256 (FIPS 180-4), over Nettle.
std::array<std::uint8_t, 32> sha256(std::string_view bytes);

}  // namespace plumbline::flight
