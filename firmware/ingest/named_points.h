// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "edge/base/result.h"
#include "edge/geodesy/geoid.h"
#include "edge/geodesy/local_frame.h"
#include "edge/survey/check_points.h"
#include "edge/survey/survey.h"

namespace plumbline::ingest {

// The small tables that refer to points by name. Each fails with one sentence, "file:line: ...".

struct Picks {
  std::vector<survey::NamedPick> picks;
  std::vector<std::string> notices;  // sentences
};

// picks.csv: photo,point,u_px,v_px[,sigma_px]. The photo is given by its file name, with or without
// the extension, or a path that ends in it; NamedPick::photo is its index in `photo_names`. Fails
// on a photo that is not among them, the same point twice in a photo, and a sigma of 0 or less.
Result<Picks> read_picks(const std::filesystem::path& path,
                         const std::vector<std::string>& photo_names);

struct Lengths {
  std::vector<survey::NamedLength> lengths;
  std::vector<std::string> notices;
};

// What a length is good to where nobody says: a steel tape read to a millimetre.
inline constexpr double kLengthSigmaM = 0.001;

// lengths.csv: point_a,point_b,length_m[,sigma_m].
Result<Lengths> read_lengths(const std::filesystem::path& path);
// The command line's A,B,METRES[,SIGMA].
Result<survey::NamedLength> parse_length(const std::string& argument);

// Where e/n/u coordinates lie on the earth and what turns orthometric heights into ellipsoidal
// ones; either may be absent. Not owned.
struct GroundFrame {
  const geodesy::LocalFrame* frame = nullptr;
  const geodesy::Geoid* geoid = nullptr;
  bool three_points =
      false;  // the results are in a frame of three points, which is not on the earth
};

struct KnownPoint {
  std::string point;
  Eigen::Vector3d in_enu_m = Eigen::Vector3d::Zero();
  std::optional<Eigen::Vector3d> sigma_m;  // east, north, up
};

struct KnownPoints {
  std::vector<KnownPoint> points;
  std::vector<std::string> notices;
};

// control.csv and check.csv: point and either e_m,n_m,u_m (local ENU: in a georeferenced survey,
// relative to the origin of its frame), or lat_deg,lon_deg or x_north_m,y_east_m,zone with
// height_ellipsoidal_m or height_orthometric_m (needs the geoid). Optional sigma_e_m, sigma_n_m,
// sigma_u_m, which are also those of north and east in the plane rectangular case. Where a row has
// both kinds, the one on the earth counts if there is a frame, e/n/u if there is none. Fails on a
// point given twice and on a row whose coordinates are not complete.
Result<KnownPoints> read_known_points(const std::filesystem::path& path, const GroundFrame& ground);

// The first place on the earth in the file, for a frame where there is no other; empty where the
// file holds e/n/u only.
Result<std::optional<geodesy::Geodetic>> first_place(const std::filesystem::path& path,
                                                     const geodesy::Geoid* geoid);

// What control is good to where its table does not say, metres per axis: set out by total station.
inline constexpr double kControlSigmaM = 0.005;
std::vector<survey::NamedControl> as_control(const KnownPoints& known);
// A check point without sigma is taken as exact.
std::vector<survey::CheckPoint> as_check_points(const KnownPoints& known);

}  // namespace plumbline::ingest
