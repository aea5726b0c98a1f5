// SPDX-License-Identifier: MIT
#include "firmware/ingest/stations.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "edge/base/units.h"
#include "firmware/ingest/gimbal.h"
#include "firmware/ingest/station_sigmas.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

using geodesy::Geodetic;
using geodesy::LocalFrame;

// What is assumed of a height where nobody says above what: the geoid lies within 50 m (one sigma
// of its undulation is 30 m over the globe) of the ellipsoid.
constexpr double kUnknownHeightSystemSigmaM = 50;

class StationBuilder {
 public:
  StationBuilder(const std::vector<PhotoRecord>& photos, const StationOptions& options)
      : records_(photos), options_(options) {}

  Result<Stations> build() {
    if (const Status read = read_places(); !read) return read.error();
    for (const PhotoRecord& record : records_) result_.photos.push_back(photo_of(record));
    if (const Status framed = set_frame(); !framed) return framed.error();
    set_times();
    set_positions();
    return std::move(result_);
  }

 private:
  bool by_geoid() const {
    return !options_.photo_heights.empty() && options_.photo_heights != "ellipsoidal";
  }

  Status read_places() {
    if (by_geoid() && options_.geoid == nullptr) {
      return Error{"The heights of the photos are said to be above " +
                   in_quotes(options_.photo_heights) + "; give that geoid with --geoid FILE."};
    }
    for (const PhotoRecord& record : records_) {
      places_.emplace_back();
      if (!record.position || !record.position->height_m) continue;
      const Result<double> height_m = ellipsoidal_height_m(*record.position);
      if (!height_m) return height_m.error();
      places_.back() =
          Geodetic{record.position->latitude_deg, record.position->longitude_deg, *height_m};
    }
    warn_of_missing();
    warn_of_heights();
    return Done{};
  }

  Result<double> ellipsoidal_height_m(const PhotoPosition& position) const {
    const bool above_geoid =
        by_geoid() || (options_.photo_heights.empty() && options_.geoid != nullptr &&
                       position.height_kind == HeightKind::kSeaLevel);
    if (!above_geoid) return *position.height_m;
    const auto undulation_m =
        options_.geoid->undulation_m(position.latitude_deg, position.longitude_deg);
    if (!undulation_m) return undulation_m.error();
    return *position.height_m + *undulation_m;
  }

  bool is_assumed(const PhotoPosition& position) const {
    if (!options_.photo_heights.empty()) return false;
    if (position.height_kind == HeightKind::kSeaLevel) return options_.geoid == nullptr;
    return position.height_kind == HeightKind::kUnknown;
  }

  void warn_of_missing() {
    const auto without =
        std::ranges::count_if(places_, [](const auto& place) { return !place.has_value(); });
    if (without == std::ssize(places_)) {
      result_.warnings.push_back(
          "The photos have no positions: without a known length or control there is no scale, and "
          "nothing is in a frame of the earth.");
    } else if (without > 0) {
      result_.warnings.push_back(std::to_string(without) + " of " + std::to_string(places_.size()) +
                                 " photos have no usable position and are placed by the others.");
    }
  }

  void warn_of_heights() {
    heights_assumed_ = false;
    for (std::size_t i = 0; i < places_.size(); ++i) {
      heights_assumed_ |= places_[i] && is_assumed(*records_[i].position);
    }
    const bool any = std::ranges::any_of(places_, [](const auto& p) { return p.has_value(); });
    result_.absolute_height_known = any && !heights_assumed_;
    if (!heights_assumed_) return;
    result_.warnings.push_back(
        "The photos do not say above what their heights are; they were taken as ellipsoidal, with "
        "a common offset of 50 m standard deviation: differences of height are not touched by "
        "this, heights above sea level or the ellipsoid are. Say it with --photo-heights.");
  }

  // The lowest place of a flight, on the ground where the drone says how high it is. Rounded, so
  // that the figures written down are the whole truth.
  Status set_frame() {
    std::optional<Geodetic> origin = options_.origin;
    for (std::size_t i = 0; i < places_.size() && !origin; ++i) {
      if (!places_[i]) continue;
      origin = Geodetic{std::round(places_[i]->latitude_deg * 1e7) / 1e7,
                        std::round(places_[i]->longitude_deg * 1e7) / 1e7,
                        std::round(places_[i]->height_ellipsoidal_m -
                                   records_[i].position->height_above_start_m.value_or(0))};
    }
    if (!origin) return Done{};
    Result<LocalFrame> frame = LocalFrame::at(*origin);
    if (!frame) return frame.error();
    result_.frame = *frame;
    return Done{};
  }

  orient::Photo photo_of(const PhotoRecord& record) const {
    orient::Photo photo;
    photo.name = record.name;
    if (record.gimbal) {
      const GimbalPriors priors = gimbal_priors(*record.gimbal);
      photo.attitude = priors.attitude;
      photo.heading = priors.heading;
    }
    photo.velocity_in_enu_m_s = record.velocity_in_enu_m_s;
    return photo;
  }

  // Seconds since the earliest photo by the camera's clock, else by GPS time; all or none.
  void set_times() {
    const auto clock = [](const PhotoRecord& record) { return record.time.camera_clock; };
    const auto gps = [](const PhotoRecord& record) { return record.time.gps; };
    const auto all = [this](const auto& time) {
      return std::ranges::all_of(records_, [&](const auto& r) { return time(r).has_value(); });
    };
    if (all(clock)) {
      fill_times(clock);
    } else if (all(gps)) {
      fill_times(gps);
    }
  }

  template <typename Time>
  void fill_times(const Time& time) {
    UtcTime first = *time(records_.front());
    for (const PhotoRecord& record : records_) first = std::min(first, *time(record));
    for (std::size_t i = 0; i < records_.size(); ++i) {
      result_.photos[i].time_s = std::chrono::duration<double>(*time(records_[i]) - first).count();
    }
    times_known_ = true;
  }

  void set_positions() {
    if (!result_.frame) return;
    std::vector<const PhotoPosition*> used;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (places_[i]) used.push_back(&*records_[i].position);
    }
    const StationSigmas sigmas = station_sigmas(used, times_known_);
    result_.gnss = sigmas.common;
    if (heights_assumed_) {
      result_.gnss.offset_sigma_vertical_m =
          std::hypot(result_.gnss.offset_sigma_vertical_m, kUnknownHeightSystemSigmaM);
    }
    std::size_t next = 0;
    for (std::size_t i = 0; i < records_.size(); ++i) {
      if (!places_[i]) continue;
      orient::Station station;
      station.antenna_in_enu_m = result_.frame->enu_of(*places_[i]);
      const Eigen::Matrix3d turn = result_.frame->enu_from_enu_at(*places_[i]);
      const Eigen::Vector3d variance_m2 = sigmas.white_m[next++].cwiseAbs2();
      station.covariance_m2 = turn * variance_m2.asDiagonal() * turn.transpose();
      result_.photos[i].station = station;
    }
    result_.warnings.insert(result_.warnings.end(), sigmas.warnings.begin(), sigmas.warnings.end());
  }

  const std::vector<PhotoRecord>& records_;
  StationOptions options_;
  Stations result_;
  std::vector<std::optional<Geodetic>> places_;  // ellipsoidal heights
  bool heights_assumed_ = false;
  bool times_known_ = false;
};

}  // namespace

Result<Stations> stations_of(const std::vector<PhotoRecord>& photos,
                             const StationOptions& options) {
  return StationBuilder(photos, options).build();
}

}  // namespace plumbline::ingest
