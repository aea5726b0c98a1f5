// SPDX-License-Identifier: MIT
#include "firmware/service/disk/found_flight.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <utility>
#include <variant>
#include <vector>

#include "edge/record/journal.h"
#include "firmware/service/disk/flight_names.h"

namespace plumbline::service {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> flights_in(const fs::path& folder) {
  std::vector<std::string> names;
  std::error_code trouble;
  for (const auto& entry : fs::directory_iterator(folder, trouble)) {
    names.push_back(entry.path().filename().string());
  }
  return flights_among(std::move(names));
}

struct Photos {
  int count = 0;
  fs::file_time_type newest = fs::file_time_type::min();
};

Photos photos_in(const fs::path& flight) {
  Photos photos;
  std::error_code trouble;
  for (const auto& file : fs::directory_iterator(flight / "photos", trouble)) {
    if (file.path().extension() != ".jpg") continue;
    const auto written = file.last_write_time(trouble);
    if (trouble) continue;
    ++photos.count;
    photos.newest = std::max(photos.newest, written);
  }
  return photos;
}

bool is_measured(const fs::path& flight, fs::file_time_type newest_photo) {
  std::error_code trouble;
  const fs::path result = flight / "result";
  if (fs::is_directory(result, trouble) && fs::is_empty(result, trouble)) return true;
  const auto measured = fs::last_write_time(result / "summary.json", trouble);
  return !trouble && measured >= newest_photo;
}

}  // namespace

std::optional<FoundFlight> newest_flight(const std::string& flights, int least_photos) {
  const std::vector<std::string> names = flights_in(flights);
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    const fs::path folder = fs::path(flights) / *name;
    const Photos photos = photos_in(folder);
    if (photos.count < least_photos) continue;
    return FoundFlight{*name, photos.count, is_measured(folder, photos.newest)};
  }
  return std::nullopt;
}

bool has_ended(const std::string& folder) {
  std::ifstream file(folder + "/flight.journal", std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(file), {}};
  auto reader = record::JournalReader::over(bytes);
  if (!reader) return false;
  bool ended = false;
  while (const auto entry = reader->next()) ended = std::holds_alternative<record::Ended>(*entry);
  return ended;
}

}  // namespace plumbline::service
