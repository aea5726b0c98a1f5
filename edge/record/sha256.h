// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

namespace plumbline::record {

// SHA-256 (FIPS 180-4), over Nettle: a library of 0.2 MB, where OpenSSL's would bring 4 MB along.
using Sha256 = std::array<std::uint8_t, 32>;
Sha256 sha256(std::string_view bytes);

// 64 lower-case hexadecimal digits.
std::string in_hex(const Sha256& digest);

}  // namespace plumbline::record
