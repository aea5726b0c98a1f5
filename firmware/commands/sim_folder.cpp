// SPDX-License-Identifier: MIT
#include "firmware/commands/sim_folder.h"

#include <algorithm>
#include <string>
#include <system_error>
#include <utility>

#include "firmware/deliver/photo_writer.h"
#include "firmware/ingest/camera_toml.h"
#include "sim/truth.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;
using deliver::write_whole_file;

constexpr double kSurfaceHalfExtent_m = 60;

// Whether the folder was there before; a sentence where it cannot be used.
Result<bool> usable(const fs::path& folder) {
  std::error_code trouble;
  const auto status = fs::status(folder, trouble);
  if (status.type() == fs::file_type::not_found) return false;
  if (!fs::is_directory(status)) {
    return Error{folder.string() + " is not a folder: name one that is new or empty."};
  }
  if (!fs::is_empty(folder, trouble) || trouble) {
    return Error{folder.string() +
                 " holds files already: a simulated flight wants a folder that is new or empty."};
  }
  return true;
}

void clear(const fs::path& folder, bool was_there) {
  std::error_code ignored;
  if (!was_there) {
    fs::remove_all(folder, ignored);
    return;
  }
  for (const char* name : {"photos", "truth", "camera.toml", "flight.journal"}) {
    fs::remove_all(folder / name, ignored);
  }
}

}  // namespace

Status write_truth(const sim::World& world, const sim::Flight& flight,
                   const geodesy::LocalFrame& frame, const fs::path& folder) {
  const double surface_m = std::min(kSurfaceHalfExtent_m, world.terrain().half_extent_m());
  const std::pair<fs::path, std::string> files[] = {
      {"camera.toml", ingest::camera_toml(flight.calibrated_camera)},
      {"truth/camera.toml", ingest::camera_toml(flight.camera)},
      {"truth/photos.csv", sim::photos_csv(flight, frame)},
      {"truth/picks.csv", sim::picks_csv(world, flight)},
      {"truth/check.csv", sim::check_csv(world, frame)},
      {"truth/surface.asc", sim::surface_asc(world, surface_m)}};
  for (const auto& [name, text] : files) {
    if (Status done = write_whole_file(folder / name, text); !done) return done;
  }
  return Done{};
}

Result<SimulatedFolder> in_new_folder(const fs::path& folder,
                                      const std::function<Result<SimulatedFolder>()>& fill) {
  const auto was_there = usable(folder);
  if (!was_there) return was_there.error();
  std::error_code trouble;
  for (const char* name : {"photos", "truth"}) {
    fs::create_directories(folder / name, trouble);
    if (!trouble) continue;
    clear(folder, *was_there);
    return Error{"the folder " + (folder / name).string() +
                 " cannot be made: " + trouble.message() + "."};
  }
  auto written = fill();
  if (!written) clear(folder, *was_there);
  return written;
}

}  // namespace plumbline::commands
