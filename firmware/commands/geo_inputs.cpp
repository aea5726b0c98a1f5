// SPDX-License-Identifier: MIT
#include "firmware/commands/geo_inputs.h"

#include "firmware/ingest/text_file.h"

namespace plumbline::commands {

Result<std::optional<geodesy::Geoid>> read_geoid(const std::filesystem::path& path) {
  if (path.empty()) return std::optional<geodesy::Geoid>();
  constexpr std::size_t kMostBytes = std::size_t{1} << 30;
  const auto bytes = ingest::read_bytes(path, kMostBytes);
  if (!bytes) return bytes.error();
  auto geoid = geodesy::Geoid::parse(*bytes, path.filename().string());
  if (!geoid) return geoid.error();
  return std::optional<geodesy::Geoid>(std::move(*geoid));
}

std::optional<deliver::GeoOrigin> geo_origin(const std::optional<geodesy::LocalFrame>& frame) {
  if (!frame) return std::nullopt;
  const geodesy::Geodetic origin = frame->origin();
  return deliver::GeoOrigin{origin.latitude_deg, origin.longitude_deg, origin.height_ellipsoidal_m};
}

std::string title_of(const std::filesystem::path& path) {
  const auto whole = std::filesystem::absolute(path).lexically_normal();
  return whole.has_filename() ? whole.filename().string() : whole.parent_path().filename().string();
}

}  // namespace plumbline::commands
