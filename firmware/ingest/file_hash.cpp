// SPDX-License-Identifier: MIT
#include "firmware/ingest/file_hash.h"

#include "edge/record/sha256.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {

std::string sha256_hex(std::span<const std::uint8_t> bytes) {
  return record::in_hex(
      record::sha256({reinterpret_cast<const char*>(bytes.data()), bytes.size()}));
}

Result<std::string> sha256_of_file(const std::filesystem::path& path) {
  const auto bytes = read_bytes(path, std::size_t{1} << 30);
  if (!bytes) return bytes.error();
  return sha256_hex(*bytes);
}

}  // namespace plumbline::ingest
