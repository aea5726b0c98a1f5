// SPDX-License-Identifier: MIT
#include "firmware/ingest/starting_camera.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <optional>

#include "firmware/ingest/sensor_table.h"
#include "firmware/ingest/text_file.h"
#include "firmware/ingest/usual_lens.h"

namespace plumbline::ingest {
namespace {

using geometry::Camera;

struct Focal {
  double px = 0;
  double sigma = 0;  // relative
  std::string from;
};

double long_side(const PhotoRecord& photo) { return std::max(photo.width_px, photo.height_px); }

// EXIF gives a focal length to two digits and at another focus; sensor widths are good to 1 to 2 %.
constexpr double kSensorSigma = 0.03;
std::optional<Focal> by_sensor(const PhotoRecord& photo) {
  const auto sensor_mm = sensor_long_side_mm(photo.make, photo.model);
  if (!sensor_mm || !photo.focal_length_mm) return std::nullopt;
  return Focal{*photo.focal_length_mm / *sensor_mm * long_side(photo), kSensorSigma,
               "the focal length in EXIF and the known sensor of " + photo.model};
}

std::optional<Focal> by_focal_plane(const PhotoRecord& photo) {
  if (!photo.focal_length_mm || !photo.focal_plane_px_per_mm) return std::nullopt;
  const Focal focal{*photo.focal_length_mm * *photo.focal_plane_px_per_mm, kSensorSigma,
                    "the focal length and the focal plane resolution in EXIF"};
  const double ratio = focal.px / long_side(photo);
  return ratio > 0.2 && ratio < 20 ? std::optional(focal) : std::nullopt;
}

// The equivalent is by the diagonal (CIPA DCG-001): 43.27 mm on 35 mm film. A photo wider than 3:2
// is cut from a sensor of 4:3 or 3:2 of the same width, whose diagonal is meant; 1.226 times the
// width lies within 2 % of both. Makers round to whole millimetres, 2 % at 24 mm.
constexpr double kEquivalentSigma = 0.05;
std::optional<Focal> by_equivalent(const PhotoRecord& photo) {
  if (!photo.focal_length_35mm) return std::nullopt;
  constexpr double kFilmDiagonalMm = 43.267;
  constexpr double kWidest = 1.55;
  const double wide = long_side(photo);
  const double narrow = std::min(photo.width_px, photo.height_px);
  const double diagonal_px = wide / narrow > kWidest ? 1.226 * wide : std::hypot(wide, narrow);
  return Focal{*photo.focal_length_35mm / kFilmDiagonalMm * diagonal_px, kEquivalentSigma,
               "the 35 mm equivalent in EXIF"};
}

Focal guess(const PhotoRecord& photo) {
  const Camera usual = usual_lens(photo.width_px, photo.height_px);
  const double px = usual.interior[geometry::kFocalLength];
  return {px, usual.sigma[geometry::kFocalLength] / px,
          "a guess, for EXIF says nothing of the lens"};
}

Focal focal_of(const PhotoRecord& photo) {
  std::optional<Focal> found = by_sensor(photo);
  if (!found) found = by_focal_plane(photo);
  if (!found) found = by_equivalent(photo);
  Focal focal = found.value_or(guess(photo));
  focal.px *= photo.digital_zoom;
  return focal;
}

std::string sentence_of(const Focal& focal) {
  char figures[80];
  std::snprintf(figures, sizeof figures, "%.0f px, with a standard deviation of %.0f %%", focal.px,
                100 * focal.sigma);
  return "The focal length to start from is by " + focal.from + ": " + figures + ".";
}

Status check_one_camera(const std::vector<PhotoRecord>& photos) {
  const PhotoRecord& first = photos.front();
  for (const PhotoRecord& photo : photos) {
    if (photo.make == first.make && photo.model == first.model) continue;
    return Error{"Photo " + in_quotes(photo.name) + " is of another camera (" + photo.model +
                 ") than " + in_quotes(first.name) + " (" + first.model +
                 "); measure photos of one camera at a time, or name the camera with --camera."};
  }
  return Done{};
}

void warn_of_zoom(const std::vector<PhotoRecord>& photos, std::vector<std::string>& warnings) {
  const PhotoRecord& first = photos.front();
  const auto focal = [](const PhotoRecord& photo) {
    return photo.focal_length_mm.value_or(0) * photo.digital_zoom;
  };
  for (const PhotoRecord& photo : photos) {
    if (std::abs(focal(photo) - focal(first)) <= 0.01 * focal(first)) continue;
    warnings.push_back("Photo " + in_quotes(photo.name) + " was taken at another zoom than " +
                       in_quotes(first.name) +
                       "; one focal length is assumed for all, so the result will be worse than "
                       "it says: leave such photos out.");
    return;
  }
}

}  // namespace

Result<StartingCamera> starting_camera(const std::vector<PhotoRecord>& photos) {
  if (const Status one = check_one_camera(photos); !one) return one.error();
  const PhotoRecord& photo = photos.front();
  const Focal focal = focal_of(photo);
  StartingCamera result;
  result.source = sentence_of(focal);
  result.camera = usual_lens(photo.width_px, photo.height_px, focal.px, focal.sigma);
  result.camera.name = photo.model.empty() ? "unknown camera" : photo.model;
  warn_of_zoom(photos, result.warnings);
  return result;
}

}  // namespace plumbline::ingest
