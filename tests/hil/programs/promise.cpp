// SPDX-License-Identifier: MIT
#include "tests/hil/programs/promise.h"

#include <random>

namespace plumbline::hil {

std::string bytes_of(std::uint64_t number) {
  std::mt19937_64 random(number);
  std::string bytes = std::to_string(number) + "\n";
  const std::size_t length = bytes.size() + 1 + random() % 65000;
  while (bytes.size() < length) bytes += static_cast<char>(random());
  return bytes;
}

std::uint64_t number_in(const std::string& bytes) {
  std::uint64_t number = 0;
  for (const char digit : bytes.substr(0, bytes.find('\n'))) {
    if (digit < '0' || digit > '9') return 0;
    number = 10 * number + static_cast<std::uint64_t>(digit - '0');
  }
  return bytes == bytes_of(number) ? number : 0;
}

}  // namespace plumbline::hil
