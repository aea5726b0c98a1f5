// SPDX-License-Identifier: MIT
#include "firmware/ingest/sha256.h"

#include <nettle/sha2.h>

#include <array>

#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {

std::string sha256_hex(std::span<const std::uint8_t> bytes) {
  sha256_ctx context;
  sha256_init(&context);
  sha256_update(&context, bytes.size(), bytes.data());
  std::array<std::uint8_t, SHA256_DIGEST_SIZE> digest;
  sha256_digest(&context, digest.size(), digest.data());
  std::string hex;
  for (const std::uint8_t byte : digest) {
    hex += "0123456789abcdef"[byte >> 4];
    hex += "0123456789abcdef"[byte & 15];
  }
  return hex;
}

Result<std::string> sha256_of_file(const std::filesystem::path& path) {
  const auto bytes = read_bytes(path, std::size_t{1} << 30);
  if (!bytes) return bytes.error();
  return sha256_hex(*bytes);
}

}  // namespace plumbline::ingest
