// SPDX-License-Identifier: MIT
#include "edge/orient/paper/heights.h"

#include <algorithm>
#include <optional>

#include "edge/base/index.h"

namespace plumbline::orient::paper {
namespace {

// Undistorted image coordinates (times f, right and up) of a point in a photo.
std::optional<Eigen::Vector2d> image_place(const Problem& problem, int photo, int point) {
  for (const Observation& o : problem.observations) {
    if (o.photo != photo || o.point != point) continue;
    const auto ray = geometry::ray_in_photo(problem.camera.interior, o.pixel);
    if (!ray) return std::nullopt;
    return problem.camera.interior[geometry::kFocalLength] * ray->head<2>();
  }
  return std::nullopt;
}

}  // namespace

Result<Heights> heights_from(const Problem& problem, const Length& length) {
  Heights out;
  const double f = problem.camera.interior[geometry::kFocalLength];
  for (std::size_t photo = 0; photo < problem.photos.size(); ++photo) {
    const auto a = image_place(problem, static_cast<int>(photo), length.point_a);
    const auto b = image_place(problem, static_cast<int>(photo), length.point_b);
    if (!a || !b || !((*b - *a).norm() > 1)) {
      return Error{"Photo " + problem.photos[photo].name +
                   " does not show both ends of the known "
                   "length (" +
                   problem.point_names[at(length.point_a)] + ", " +
                   problem.point_names[at(length.point_b)] +
                   "), which the published procedure needs in every photo (eq. 1); measure them "
                   "there, leave the photo out, or use the rigorous adjustment (without --paper)."};
    }
    out.length_px.push_back((*b - *a).norm());
    out.height_m.push_back(length.metres * f / out.length_px.back());  // eq. 1
  }
  const auto lowest = std::min_element(out.height_m.begin(), out.height_m.end());
  out.lowest = static_cast<int>(lowest - out.height_m.begin());
  for (const double height : out.height_m) out.base_z_m.push_back(height - *lowest);  // eq. 2
  return out;
}

}  // namespace plumbline::orient::paper
