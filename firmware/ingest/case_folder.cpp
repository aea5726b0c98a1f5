// SPDX-License-Identifier: MIT
#include "firmware/ingest/case_folder.h"

#include <algorithm>
#include <system_error>
#include <utility>

#include "firmware/ingest/camera_toml.h"
#include "firmware/ingest/case_files.h"
#include "firmware/ingest/file_hash.h"
#include "firmware/ingest/named_points.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

namespace fs = std::filesystem;

// Photos, observations and points beyond these are a mistake, not a climb.
constexpr std::size_t kMaxPhotos = 10'000;
constexpr std::size_t kMaxObservations = 5'000'000;

class CaseReader {
 public:
  CaseReader(const fs::path& folder, const geodesy::Geoid* geoid)
      : folder_(folder), geoid_(geoid) {}

  Result<CaseFolder> read() {
    std::error_code error;
    if (!fs::is_directory(folder_, error)) {
      return Error{in_quotes(folder_.string()) +
                   " is not a folder; a case is a folder with "
                   "camera.toml, photos.csv and observations.csv."};
    }
    for (const auto step :
         {&CaseReader::read_camera, &CaseReader::read_photos, &CaseReader::read_observations,
          &CaseReader::read_lengths_, &CaseReader::place_on_earth, &CaseReader::read_control,
          &CaseReader::read_check, &CaseReader::read_frame_roles, &CaseReader::read_lever_arm,
          &CaseReader::read_gnss}) {
      if (const Status done = (this->*step)(); !done) return done.error();
    }
    return std::move(result_);
  }

 private:
  bool has(const char* file) const {
    std::error_code error;
    return fs::exists(folder_ / file, error);
  }

  void warn(const std::vector<std::string>& sentences) {
    result_.warnings.insert(result_.warnings.end(), sentences.begin(), sentences.end());
  }

  // The hash of what was read goes into the summary, so that a result names its input.
  Result<std::string> text_of(const char* file) {
    Result<std::string> text = read_text_file(folder_ / file);
    if (!text) return text;
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(text->data());
    result_.input_sha256[file] = sha256_hex({bytes, text->size()});
    return text;
  }

  Result<CsvTable> table_of(const char* file) {
    const Result<std::string> text = text_of(file);
    if (!text) return text.error();
    return parse_csv(*text, file);
  }

  Status read_camera() {
    const Result<std::string> text = text_of("camera.toml");
    if (!text) return text.error();
    Result<CameraFile> camera = parse_camera_toml(*text, "camera.toml");
    if (!camera) return camera.error();
    result_.problem.camera = std::move(camera->camera);
    warn(camera->notices);
    return Done{};
  }

  Status read_photos() {
    const Result<CsvTable> table = table_of("photos.csv");
    if (!table) return table.error();
    if (table->rows.size() > kMaxPhotos) return Error{"photos.csv: more than 10000 photos."};
    Result<std::vector<orient::Photo>> photos = case_photos(*table, result_.warnings);
    if (!photos) return photos.error();
    result_.problem.photos = *std::move(photos);
    return Done{};
  }

  Status read_observations() {
    const Result<CsvTable> table = table_of("observations.csv");
    if (!table) return table.error();
    if (table->rows.size() > kMaxObservations) {
      return Error{"observations.csv: more than 5 million observations."};
    }
    Result<PointNumbers> points = case_observations(*table, result_.problem, result_.warnings);
    if (!points) return points.error();
    points_ = *std::move(points);
    return Done{};
  }

  // A length between points that no photo sees says nothing.
  Status read_lengths_() {
    if (!has("lengths.csv")) return Done{};
    if (const auto text = text_of("lengths.csv"); !text) return text.error();
    const Result<Lengths> lengths = read_lengths(folder_ / "lengths.csv");
    if (!lengths) return lengths.error();
    for (const survey::NamedLength& length : lengths->lengths) {
      const auto a = points_.find(length.point_a);
      const auto b = points_.find(length.point_b);
      if (a == points_.end() || b == points_.end()) {
        const std::string& missing = a == points_.end() ? length.point_a : length.point_b;
        return Error{"lengths.csv: the point " + in_quotes(missing) +
                     " is not in observations.csv."};
      }
      result_.problem.lengths.push_back({a->second, b->second, length.metres, length.sigma_m});
    }
    warn(lengths->notices);
    return Done{};
  }

  // The photos' e/n/u have no known origin, so a frame on the earth can be chosen only without
  // them.
  Status place_on_earth() {
    const bool photos_have_enu = std::ranges::any_of(
        result_.problem.photos, [](const auto& p) { return p.station.has_value(); });
    if (photos_have_enu) return Done{};
    for (const char* file : {"control.csv", "check.csv"}) {
      if (!has(file) || result_.frame) continue;
      const Result<std::optional<geodesy::Geodetic>> place = first_place(folder_ / file, geoid_);
      if (!place) return place.error();
      if (!*place) continue;
      Result<geodesy::LocalFrame> frame = geodesy::LocalFrame::at(**place);
      if (!frame) return frame.error();
      result_.frame = *frame;
    }
    return Done{};
  }

  Result<KnownPoints> known(const char* file, bool three_points = false) {
    if (const auto text = text_of(file); !text) return text.error();
    Result<KnownPoints> points = read_known_points(
        folder_ / file, {result_.frame ? &*result_.frame : nullptr, geoid_, three_points});
    if (points) warn(points->notices);
    return points;
  }

  Status read_control() {
    if (!has("control.csv")) return Done{};
    const Result<KnownPoints> points = known("control.csv");
    if (!points) return points.error();
    for (const survey::NamedControl& control : as_control(*points)) {
      const auto number = points_.find(control.point);
      if (number == points_.end()) {
        warn({"control.csv: the point " + in_quotes(control.point) +
              " is seen in no photo and was left out."});
        continue;
      }
      result_.problem.control.push_back({number->second, control.in_enu_m, control.covariance_m2});
    }
    warn(unstated_control(*points));
    return Done{};
  }

  static std::vector<std::string> unstated_control(const KnownPoints& points) {
    const auto stated = [](const KnownPoint& point) { return point.sigma_m.has_value(); };
    if (std::ranges::all_of(points.points, stated)) return {};
    return {"control.csv states no sigma for some points; 5 mm per axis was assumed."};
  }

  Status read_check() {
    if (!has("check.csv")) return Done{};
    const Result<KnownPoints> points = known("check.csv", has("frame.csv"));
    if (!points) return points.error();
    result_.check = as_check_points(*points);
    return Done{};
  }

  Status read_frame_roles() {
    if (!has("frame.csv")) return Done{};
    const Result<CsvTable> table = table_of("frame.csv");
    if (!table) return table.error();
    const Result<orient::FrameRoles> roles = case_frame_roles(*table, points_, result_.warnings);
    if (!roles) return roles.error();
    result_.frame_roles = *roles;
    return Done{};
  }

  Status read_lever_arm() {
    if (!has("lever_arm.csv")) return Done{};
    const Result<CsvTable> table = table_of("lever_arm.csv");
    if (!table) return table.error();
    const Result<orient::LeverArm> arm = case_lever_arm(*table, result_.warnings);
    if (!arm) return arm.error();
    result_.problem.lever_arm = *arm;
    return Done{};
  }

  Status read_gnss() {
    if (!has("gnss.toml")) return Done{};
    const Result<std::string> text = text_of("gnss.toml");
    if (!text) return text.error();
    const Result<CaseGnss> gnss = case_gnss(*text, "gnss.toml", result_.warnings);
    if (!gnss) return gnss.error();
    result_.problem.gnss = gnss->errors;
    result_.problem.delay = gnss->delay;
    const bool delayed = gnss->delay.seconds != 0 || gnss->delay.sigma_s > 0;
    for (const orient::Photo& photo : result_.problem.photos) {
      if (!delayed || !photo.station || photo.velocity_in_enu_m_s) continue;
      return Error{"gnss.toml gives a delay, but photo " + in_quotes(photo.name) +
                   " has no ve_m_s, vn_m_s, vu_m_s in photos.csv; write 0 where it stood still."};
    }
    if (gnss->errors.correlation_s == 0) return Done{};
    for (const orient::Photo& photo : result_.problem.photos) {
      if (!photo.station || photo.time_s) continue;
      return Error{"gnss.toml gives correlation_s, but photo " + in_quotes(photo.name) +
                   " has no time_s in photos.csv."};
    }
    return Done{};
  }

  fs::path folder_;
  const geodesy::Geoid* geoid_;
  CaseFolder result_;
  PointNumbers points_;
};

}  // namespace

Result<CaseFolder> read_case(const fs::path& folder, const geodesy::Geoid* geoid) {
  return CaseReader(folder, geoid).read();
}

}  // namespace plumbline::ingest
