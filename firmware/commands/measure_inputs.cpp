// SPDX-License-Identifier: MIT
#include "firmware/commands/measure_inputs.h"

#include <algorithm>
#include <set>
#include <utility>

#include "edge/base/units.h"
#include "firmware/commands/antenna_stations.h"
#include "firmware/commands/geo_inputs.h"
#include "firmware/commands/lever_arm.h"
#include "firmware/config/config_toml.h"
#include "firmware/ingest/camera_toml.h"
#include "firmware/ingest/file_hash.h"
#include "firmware/ingest/flight_journal.h"
#include "firmware/ingest/gnss_log.h"
#include "firmware/ingest/named_points.h"
#include "firmware/ingest/photo_folder.h"
#include "firmware/ingest/starting_camera.h"
#include "firmware/ingest/stations.h"
#include "firmware/ingest/tie_table.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;

// As the program was configured that flew.
config::Config config_of_flight(const ingest::FlightJournal& journal) {
  for (const auto& entry : journal.entries) {
    const auto* began = std::get_if<record::Began>(&entry);
    if (began != nullptr) return config::parse_config(began->configuration, "").config;
  }
  return {};
}

class InputReader {
 public:
  InputReader(const MeasureArguments& arguments, const Progress& progress)
      : arguments_(arguments), progress_(progress) {}

  Result<MeasureInputs> read() {
    using Step = Status (InputReader::*)();
    for (const Step step :
         {&InputReader::read_geoid_file, &InputReader::read_photo_files, &InputReader::read_camera,
          &InputReader::read_stations, &InputReader::read_flight, &InputReader::read_gnss,
          &InputReader::read_lever_arm, &InputReader::read_picks_and_lengths,
          &InputReader::read_ties, &InputReader::read_known}) {
      if (Status done = (this->*step)(); !done) return done.error();
    }
    return std::move(inputs_);
  }

 private:
  void warn(const std::vector<std::string>& sentences) {
    inputs_.warnings.insert(inputs_.warnings.end(), sentences.begin(), sentences.end());
  }

  Status remember(const fs::path& path) {
    auto hash = ingest::sha256_of_file(path);
    if (!hash) return hash.error();
    inputs_.sha256[path.filename().string()] = *hash;
    return Done{};
  }

  Status read_geoid_file() {
    auto geoid = commands::read_geoid(arguments_.geoid);
    if (!geoid) return geoid.error();
    geoid_ = std::move(*geoid);
    return geoid_ ? remember(arguments_.geoid) : Status(Done{});
  }

  Status read_photo_files() {
    auto set = ingest::read_photos(arguments_.photos, arguments_.threads, progress_);
    if (!set) return set.error();
    photos_ = std::move(*set);
    inputs_.photos_given = photos_.photos_given;
    warn(photos_.warnings);
    for (const auto& photo : photos_.photos) inputs_.sha256[photo.name] = photo.sha256;
    inputs_.survey.images = [photos = photos_.photos](int photo) {
      return ingest::load_grey(photos[static_cast<std::size_t>(photo)]);
    };
    return Done{};
  }

  Status read_camera() {
    const fs::path path =
        arguments_.camera.empty() ? photos_.camera_toml.value_or(fs::path()) : arguments_.camera;
    if (path.empty()) {
      auto camera = ingest::starting_camera(photos_.photos);
      if (!camera) return camera.error();
      inputs_.survey.camera = camera->camera;
      inputs_.warnings.push_back(camera->source);
      warn(camera->warnings);
      return Done{};
    }
    auto file = ingest::read_camera_toml(path);
    if (!file) return file.error();
    inputs_.survey.camera = file->camera;
    warn(file->notices);
    if (Status sized = check_size(path); !sized) return sized;
    return remember(path);
  }

  Status check_size(const fs::path& path) const {
    const auto& camera = inputs_.survey.camera;
    const auto& photo = photos_.photos.front();
    if (camera.width_px == photo.width_px && camera.height_px == photo.height_px) return Done{};
    return Error{path.filename().string() + " is for pictures of " +
                 std::to_string(camera.width_px) + " x " + std::to_string(camera.height_px) +
                 " pixels, but the photos have " + std::to_string(photo.width_px) + " x " +
                 std::to_string(photo.height_px) + "; give the camera of these photos."};
  }

  Status read_stations() {
    const ingest::StationOptions options{arguments_.photo_heights, geoid_ ? &*geoid_ : nullptr,
                                         std::nullopt};
    auto stations = ingest::stations_of(photos_.photos, options);
    if (!stations) return stations.error();
    inputs_.survey.photos = std::move(stations->photos);
    inputs_.survey.gnss = stations->gnss;
    inputs_.frame = stations->frame;
    if (arguments_.gnss.empty() && !flight_journal()) warn(stations->warnings);
    return Done{};
  }

  std::optional<fs::path> flight_journal() const {
    if (arguments_.photos.size() != 1) return std::nullopt;
    return ingest::journal_of(arguments_.photos.front());
  }

  // A flight of the daemon says itself where its photos were taken.
  Status read_flight() {
    const auto path = flight_journal();
    if (!arguments_.gnss.empty() || !path) return Done{};
    const auto journal = ingest::read_flight_journal(*path);
    if (!journal) return journal.error();
    const std::vector<std::string> names = photo_names();
    const config::Config config = config_of_flight(*journal);
    const auto antenna = antenna_of_flight(*journal, names, config.capture);
    warn(antenna.warnings);
    put_headings(headings_of_flight(*journal, names), config.pilot);
    if (Status placed = place_antennas(antenna, inputs_.frame, inputs_.survey); !placed) {
      return placed;
    }
    return remember(*path);
  }

  void put_headings(const std::vector<std::optional<double>>& vehicle_rad,
                    const config::PilotConfig& pilot) {
    if (!pilot.photo_top_deg) return;
    for (std::size_t k = 0; k < vehicle_rad.size(); ++k) {
      if (!vehicle_rad[k]) continue;
      inputs_.survey.photos[k].heading = {*vehicle_rad[k] + *pilot.photo_top_deg * kRadPerDeg,
                                          pilot.heading_sigma_deg * kRadPerDeg};
    }
  }

  // A log given by hand stands for the photos' own positions, all of them.
  Status read_gnss() {
    if (arguments_.gnss.empty()) return Done{};
    auto log = ingest::read_gnss_log(arguments_.gnss);
    if (!log) return log.error();
    std::optional<ingest::TimeOffset> offset;
    if (!arguments_.time_offset.empty()) {
      auto parsed = ingest::parse_time_offset(arguments_.time_offset);
      if (!parsed) return parsed.error();
      offset = *parsed;
    }
    std::vector<ingest::PhotoMoment> moments;
    for (const auto& photo : photos_.photos) moments.push_back({photo.name, photo.time});
    auto antenna = ingest::antenna_at_photos(*log, moments, offset);
    if (!antenna) return antenna.error();
    warn(antenna->warnings);
    if (Status placed = place_antennas(*antenna, inputs_.frame, inputs_.survey); !placed) {
      return placed;
    }
    return remember(arguments_.gnss);
  }

  Status read_lever_arm() {
    if (arguments_.lever_arm.empty()) return Done{};
    auto arm = parse_lever_arm(arguments_.lever_arm, arguments_.lever_frame, inputs_.survey.photos);
    if (!arm) return arm.error();
    inputs_.survey.lever_arm = *arm;
    return Done{};
  }

  Status read_picks_and_lengths() {
    if (!arguments_.picks.empty()) {
      auto picks = ingest::read_picks(arguments_.picks, photo_names());
      if (!picks) return picks.error();
      inputs_.survey.picks = std::move(picks->picks);
      warn(picks->notices);
      if (Status inside = check_picks(); !inside) return inside;
      if (Status hashed = remember(arguments_.picks); !hashed) return hashed;
    }
    for (const std::string& text : arguments_.lengths) {
      auto length = ingest::parse_length(text);
      if (!length) return length.error();
      for (const std::string& end : {length->point_a, length->point_b}) {
        if (is_picked(end)) continue;
        return Error{"The known length " + length->point_a + " to " + length->point_b +
                     " names a point that was not picked in any photo: " + end +
                     "; give its picks with --picks."};
      }
      inputs_.survey.lengths.push_back(*length);
    }
    return Done{};
  }

  Status read_ties() {
    if (arguments_.ties_from.empty()) return Done{};
    const auto& picks = inputs_.survey.picks;
    std::set<std::string> named;
    for (const auto& pick : picks) {
      named.insert(pick.point);
      if (std::ranges::count(picks, pick.point, &survey::NamedPick::point) > 1) continue;
      return Error{"The point " + pick.point +
                   " is picked in one photo only; it is found in the others where ties are found "
                   "anew, without --ties-from."};
    }
    const fs::path path = arguments_.ties_from / "observations.csv";
    auto ties = ingest::read_ties(path, photo_names(), named);
    if (!ties) return ties.error();
    inputs_.survey.ties = std::move(*ties);
    return remember(path);
  }

  std::vector<std::string> photo_names() const {
    std::vector<std::string> names;
    for (const auto& photo : photos_.photos) names.push_back(photo.name);
    return names;
  }

  bool is_picked(const std::string& point) const {
    return std::ranges::any_of(inputs_.survey.picks,
                               [&](const auto& pick) { return pick.point == point; });
  }

  // Half a photo beyond its edge is a slip of units, not a pick.
  Status check_picks() const {
    const Eigen::Array2d size(photos_.photos.front().width_px, photos_.photos.front().height_px);
    for (const auto& pick : inputs_.survey.picks) {
      const Eigen::Array2d at = pick.pixel.array() / size;
      if ((at > -0.5).all() && (at < 1.5).all()) continue;
      return Error{arguments_.picks.filename().string() + ": The pick of point '" + pick.point +
                   "' lies far outside photo '" +
                   photos_.photos[static_cast<std::size_t>(pick.photo)].name + "' of " +
                   std::to_string(photos_.photos.front().width_px) + " x " +
                   std::to_string(photos_.photos.front().height_px) + " pixels."};
    }
    return Done{};
  }

  Result<ingest::KnownPoints> read_points(const fs::path& path) {
    if (!inputs_.frame) {
      auto place = ingest::first_place(path, geoid_ ? &*geoid_ : nullptr);
      if (!place) return place.error();
      if (*place) {
        auto frame = geodesy::LocalFrame::at(**place);
        if (!frame) return frame.error();
        inputs_.frame = *frame;
      }
    }
    auto points = ingest::read_known_points(
        path, {inputs_.frame ? &*inputs_.frame : nullptr, geoid_ ? &*geoid_ : nullptr});
    if (!points) return points;
    warn(points->notices);
    if (Status hashed = remember(path); !hashed) return hashed.error();
    return points;
  }

  Status read_known() {
    if (!arguments_.control.empty()) {
      auto points = read_points(arguments_.control);
      if (!points) return points.error();
      inputs_.survey.control = ingest::as_control(*points);
      if (Status found = check_control(); !found) return found;
    }
    if (!arguments_.check.empty()) {
      auto points = read_points(arguments_.check);
      if (!points) return points.error();
      inputs_.check = ingest::as_check_points(*points);
      if (std::ranges::none_of(inputs_.check, [&](const auto& c) { return is_picked(c.point); })) {
        return Error{"None of the " + std::to_string(inputs_.check.size()) + " check points of " +
                     arguments_.check.filename().string() +
                     " was picked in any photo; give their picks with --picks, named alike."};
      }
    }
    return Done{};
  }

  Status check_control() {
    for (const auto& control : inputs_.survey.control) {
      if (is_picked(control.point)) continue;
      inputs_.warnings.push_back("Control point " + control.point +
                                 " was not picked in any photo and was not used.");
    }
    return Done{};
  }

  const MeasureArguments& arguments_;
  const Progress& progress_;
  MeasureInputs inputs_;
  ingest::PhotoSet photos_;
  std::optional<geodesy::Geoid> geoid_;
};

}  // namespace

Result<MeasureInputs> read_measure_inputs(const MeasureArguments& arguments,
                                          const Progress& progress) {
  return InputReader(arguments, progress).read();
}

}  // namespace plumbline::commands
