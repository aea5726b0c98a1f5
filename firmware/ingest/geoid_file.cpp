// SPDX-License-Identifier: MIT
#include "firmware/ingest/geoid_file.h"

#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {

Result<geodesy::Geoid> read_geoid(const std::filesystem::path& path) {
  const auto bytes = read_bytes(path, kMaxTextBytes);
  if (!bytes) return bytes.error();
  return geodesy::Geoid::parse(*bytes, path.filename().string());
}

}  // namespace plumbline::ingest
