// SPDX-License-Identifier: MIT
#include "tests/hil/host/flight_truth.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <utility>

#include "edge/jpeg/jpeg.h"
#include "firmware/ingest/camera_toml.h"
#include "sim/truth.h"
#include "tests/hil/host/exposure_mark.h"

namespace plumbline::hil {
namespace {

namespace fs = std::filesystem;

Result<std::uint64_t> mark_of(const fs::path& photo) {
  std::ifstream file(photo, std::ios::binary);
  const std::vector<std::uint8_t> bytes{std::istreambuf_iterator<char>(file), {}};
  const auto grey = jpeg::decode_grey(bytes, photo.filename().string());
  if (!grey) return grey.error();
  std::vector<std::uint8_t> yuy2;  // its first row
  for (int u = 0; u < grey->width_px; ++u) {
    yuy2.push_back(grey->data[static_cast<std::size_t>(u)]);
    yuy2.push_back(128);
  }
  if (const auto mark = read_exposure_mark(yuy2)) return *mark;
  return Error{photo.string() + " bears no mark of its exposure: is it a photo of the bench?"};
}

}  // namespace

Result<std::vector<sim::BenchFlight::Taken>> read_marks(const fs::path& photos,
                                                        std::int64_t begun_ns) {
  std::vector<sim::BenchFlight::Taken> taken;
  std::error_code trouble;
  for (const auto& entry : fs::directory_iterator(photos, trouble)) {
    if (entry.path().extension() != ".jpg") continue;
    const auto mark = mark_of(entry.path());
    if (!mark) return mark.error();
    const auto since_ns = static_cast<std::int64_t>(*mark) - begun_ns;
    taken.push_back({entry.path().filename().string(), 1e-9 * static_cast<double>(since_ns)});
  }
  if (trouble) return Error{"Cannot read " + photos.string() + ": " + trouble.message() + "."};
  std::sort(taken.begin(), taken.end(),
            [](const auto& a, const auto& b) { return a.photo < b.photo; });
  return taken;
}

Status write_truth(const sim::BenchFlight& flight,
                   const std::vector<sim::BenchFlight::Taken>& taken, const fs::path& recording) {
  const sim::Flight flown = flight.flown(taken);
  const fs::path folder = recording / "truth";
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  const std::pair<const char*, std::string> files[] = {
      {"camera.toml", ingest::camera_toml(flown.camera)},
      {"photos.csv", sim::photos_csv(flown, flight.frame())},
      {"picks.csv", sim::picks_csv(flight.world(), flown)},
      {"check.csv", sim::check_csv(flight.world(), flight.frame())}};
  for (const auto& [name, content] : files) {
    std::ofstream file(folder / name, std::ios::binary | std::ios::trunc);
    file << content;
    if (!file.flush()) return Error{"Cannot write " + (folder / name).string() + "."};
  }
  return Done{};
}

}  // namespace plumbline::hil
