// SPDX-License-Identifier: MIT
#include "firmware/service/disk/disk_space.h"

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "firmware/service/disk/flight_names.h"

namespace plumbline::service {
namespace {

constexpr PhotoSize kUsual{4056, 3040};
constexpr double kWidestShape = 16.0 / 9;
constexpr double kGridFlight_s = 1800;
constexpr double kGridSpeed_m_s = 5;
constexpr double kBytesPerPixel = 3.0 / 8;  // of a JPEG of much detail

// The flight that is being recorded, and the one before it, which may still be measured.
constexpr std::size_t kKept = 2;

bool clean_result(Storage& storage, const std::string& folder) {
  const auto names = storage.list(folder);
  if (!names) return false;
  bool is_cleaner = false;
  for (const std::string& name : *names) {
    is_cleaner = storage.remove(std::string(folder).append("/").append(name)).ok() || is_cleaner;
  }
  return is_cleaner;
}

}  // namespace

PhotoSize photo_size(const CameraOptions& options, std::optional<int> rows_seen) {
  PhotoSize size = kUsual;
  if (rows_seen) size = {static_cast<int>(std::lround(kWidestShape * *rows_seen)), *rows_seen};
  return {options.width_px.value_or(size.width_px), options.height_px.value_or(size.height_px)};
}

std::optional<std::int64_t> photos_that_fit(Storage& storage, const PhotoSize& photo,
                                            double keep_free_mb) {
  const auto free = storage.free_bytes();
  if (!free) return std::nullopt;
  const double photo_bytes = kBytesPerPixel * photo.width_px * photo.height_px;
  const double room_bytes = std::max(0.0, static_cast<double>(*free) - 1e6 * keep_free_mb);
  return static_cast<std::int64_t>(room_bytes / photo_bytes);
}

std::int64_t photos_planned(const capture::CapturePlan& plan) {
  double photos = static_cast<double>(plan.heights_m.size()) + (plan.aside_m ? 1 : 0);
  if (plan.every) photos += kGridFlight_s / in_seconds(*plan.every);
  if (plan.every_m) photos += kGridFlight_s * kGridSpeed_m_s / *plan.every_m;
  return static_cast<std::int64_t>(std::ceil(photos));
}

int clean_results(Storage& storage, const std::function<bool()>& is_enough) {
  const auto names = storage.list("");
  if (!names) return 0;
  std::vector<std::string> flights = flights_among(*names);
  flights.resize(flights.size() - std::min(flights.size(), kKept));
  int cleaned = 0;
  for (const std::string& flight : flights) {
    if (is_enough()) break;
    cleaned += clean_result(storage, flight + "/result") ? 1 : 0;
  }
  return cleaned;
}

}  // namespace plumbline::service
