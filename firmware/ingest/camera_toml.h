// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/geometry/camera.h"

namespace plumbline::ingest {

// camera.toml. Keys: name, width_px, height_px, focal_length_px (these three required),
// principal_point_px (default: the centre of the image), affinity, skew, radial, tangential
// (default 0), line_time_us (default 0).
//
// [sigma] has the same keys (without name and size): the prior standard deviation of each entry.
// 0 holds it fixed, missing leaves it free; in a list one entry alone may be left free with the
// word "free": radial = [0.1, "free", 0]. Without [sigma] and [covariance] all ten are free.
// line_time_us is the time from one row to the next, from the top down: row v is exposed
// (v - (height_px - 1) / 2) line times after the middle row, for which the pose of a photo holds.
// It is an unknown of the adjustment only where it has a sigma; that is 0 where missing.
//
// [covariance] holds order = [names] and matrix = [[...]], the joint covariance of those named, in
// the units of the entries; it is used instead of [sigma]. An entry of a list has a name of its
// own, those of geometry::kInteriorNames:
//   focal_length_px principal_point_u_px principal_point_v_px affinity skew
//   radial_1 radial_2 radial_3 tangential_1 tangential_2
// and also principal_point_px[0], radial[2], tangential[1] or cu, cv, k1, k2, k3, p1, p2. What is
// not in the list keeps its [sigma], uncorrelated, and is held fixed where it has none. A
// [covariance] that holds nothing is as none.
struct CameraFile {
  geometry::Camera camera;
  std::vector<std::string> notices;  // sentences: keys that were ignored
};

// `name` is the file's name for sentences. Fails with "name:line: sentence".
Result<CameraFile> parse_camera_toml(const std::string& text, const std::string& name);
Result<CameraFile> read_camera_toml(const std::filesystem::path& path);

// The text of camera.toml. Every number reads back as the same double; with a covariance, [sigma]
// holds the square roots of its diagonal. The same camera gives the same text.
std::string camera_toml(const geometry::Camera& camera);

}  // namespace plumbline::ingest
