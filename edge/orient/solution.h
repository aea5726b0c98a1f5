// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "edge/geometry/camera.h"

namespace plumbline::orient {

using Matrix6d = Eigen::Matrix<double, 6, 6>;

// How well the rest of the network checks a station (Baarda 1968).
struct StationCheck {
  int directions = 0;    // that can be checked at all
  double statistic = 0;  // chi-square of that many degrees of freedom where the station is right
  double critical = 0;   // beyond which it is said to be wrong: 1 % of all flights by design
  double noncentrality = 0;  // of the smallest error found with 99 %
  // The non-centrality of the statistic under an error g (east, north, up) is g' detectability g.
  Eigen::Matrix3d detectability = Eigen::Matrix3d::Zero();
  Eigen::Vector3d redundancy = Eigen::Vector3d::Zero();  // east, north, up: 0 = unchecked, 1
  // The smallest error along each axis alone that is found with 99 %; infinite: none is.
  Eigen::Vector3d minimal_detectable_m = Eigen::Vector3d::Zero();
};

struct OrientedPhoto {
  bool oriented = false;  // false: nothing below is known
  geometry::Pose pose;
  // Of (centre east, north, up in m; rotation increment east, north, up in rad, applied on the
  // left: R <- exp([delta]x) R).
  Matrix6d covariance = Matrix6d::Zero();
  Eigen::Vector3d sigma_omega_phi_kappa_rad = Eigen::Vector3d::Zero();
  // Antenna as measured minus as adjusted; zero size where there is no station.
  std::optional<Eigen::Vector3d> gnss_residual_m;
  bool station_rejected = false;
  std::optional<StationCheck> station_check;
};

struct MeasuredPoint {
  bool measured = false;  // false: fewer than two good rays, nothing below is known
  Eigen::Vector3d in_enu_m = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // in the datum of the adjustment
  // About the points' own best-fit frame (position, azimuth, tilt and scale of the whole removed):
  // what remains when only shape matters.
  Eigen::Matrix3d local_covariance_m2 = Eigen::Matrix3d::Zero();
  int rays = 0;
  double residual_rms_px = 0;
};

struct ObservationResidual {
  Eigen::Vector2d residual_px = Eigen::Vector2d::Zero();  // measured minus computed
  double sigma_px = 0;                                    // as used at the end
  bool used = false;
  // Of u and v: the share of an error that shows in the residual (redundancy number), and the
  // residual over its own sigma (w test, Baarda 1968). A rejected observation, not part of the
  // adjustment, is compared with what the rest predicts; its redundancy is NaN. NaN, too, where
  // its point was not measured.
  Eigen::Vector2d redundancy = Eigen::Vector2d::Constant(std::nan(""));
  Eigen::Vector2d w = Eigen::Vector2d::Constant(std::nan(""));
};

// A quantity that the data do not fix, and what to do about it.
struct Unobservable {
  std::string name;      // azimuth, tilt, focal_length, scale, height, position, ...
  std::string sentence;  // with its figures: what is not known, and what would make it so
};

// Something known before that all the rest contradicts. It was not used.
struct Blunder {
  std::string kind;      // station, length, control, focal_length, interior, exchanged_names
  std::string subject;   // the photo, the points or the parameter
  std::string sentence;  // with its figures
  double size = 0;       // of the error, in the unit of the thing (m, px); NaN: nothing tells it
  double statistic = 0;  // and the critical value it exceeded
  double critical = 0;
};

// A quantity that one single thing carries, so that nothing would show if that were wrong.
struct Unchecked {
  std::string quantity;  // azimuth, scale, ...
  std::string subject;
  std::string sentence;
};

// Two quantities that the data do not tell apart (see correlations.h for their names).
struct Correlation {
  std::string a, b;
  double value = 0;  // -1 to 1
};

// A combination of camera and photos that is known worse than others, by the angle that it moves
// the images by, and the quantities it goes with, each with its correlation.
struct WeakCombination {
  double sigma_rad = 0;
  std::vector<std::pair<std::string, double>> goes_with;
};

// Standard deviations of what is common to the whole. Infinity: not fixed by anything.
struct CommonSigmas {
  double azimuth_rad = 0;
  double tilt_rad = 0;
  double scale = 0;         // relative
  double position_m = 0;    // of the points' centroid, largest axis
  double focal_length = 0;  // relative
  double height = 0;        // median sigma of point heights over the flying height
};

// A quantity of time, where it was adjusted or given.
struct TimeEstimate {
  double seconds = 0;
  double sigma_s = 0;
};

struct Summary {
  bool converged = false;
  int iterations = 0;
  double sigma0 = 0;
  std::map<std::string, double>
      sigma0_by_group;  // ties, picks, stated, gnss, lengths, control, ...
  double image_sigma_px = 0;
  double image_design_effect = 1;  // variances of ties were widened by it: neighbours err alike
  int redundancy = 0;
  int observations_rejected = 0;
  double reprojection_rms_px = 0;
  double flying_height_m = 0;  // median height of the stations above the median ground
  CommonSigmas common;
  std::optional<TimeEstimate> delay;      // of the exposures behind the stations' clock
  std::optional<TimeEstimate> line_time;  // of the rolling shutter, per row
  std::vector<Unobservable> unobservable;
  std::vector<Correlation> correlations;  // the strong ones
  std::vector<WeakCombination> weakest;   // the worst known first
  std::vector<Blunder> blunders;
  std::vector<Unchecked> unchecked;
  std::vector<std::string> warnings;  // sentences; those of blunders and unchecked among them
};

// Covariance between any of the adjusted points. Kept because a distance, an area or a joint test
// needs more than 3x3 blocks.
class PointCovariances {
 public:
  virtual ~PointCovariances() = default;
  // 3n x 3n, in the order of `points` (indices of measured points; one may be there twice), m2.
  virtual Eigen::MatrixXd joint(const std::vector<int>& points) const = 0;
  // 6 x 3n: of an oriented photo (centre, rotation increment: as OrientedPhoto) with the points.
  virtual Eigen::MatrixXd with_photo(int photo, const std::vector<int>& points) const = 0;
};

// Three points that make a local frame: the origin, a point on the x axis, a third in the x-y
// plane. Indices of Problem::point_names.
struct FrameRoles {
  int origin = 0;
  int x_axis = 0;
  int plane = 0;
};

struct Solution {
  geometry::Camera camera;                     // as adjusted; `covariance` is the posterior one
  std::vector<OrientedPhoto> photos;           // as Problem::photos
  std::vector<MeasuredPoint> points;           // as Problem::point_names
  std::vector<ObservationResidual> residuals;  // as Problem::observations
  Summary summary;
  std::shared_ptr<const PointCovariances> covariances;  // immutable once made
  // Where given, all places are X, Y, Z of this local frame instead of east, north, up.
  std::optional<FrameRoles> frame;
};

}  // namespace plumbline::orient
