// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>

#include "edge/geometry/camera.h"
#include "edge/orient/adjust.h"

namespace plumbline::plan {

struct Rtk {
  double sigma_horizontal_m = 0.005;  // white, of each position
  double sigma_vertical_m = 0.010;
};

// What a change of the flight is taken to cost, in seconds. A photo lower down or in between is
// taken on the way, and costs its stop alone. Ground work is done once, before the flight.
struct Costs {
  double climb_rate_m_s = 2;    // up; down again as fast
  double aside_rate_m_s = 2;    // out and straight back
  double stop_s = 2;            // for each photo
  double heading_2deg_s = 300;  // a compass, calibrated on the spot
  double heading_1deg_s = 600;
  double length_s = 400;   // two marks and a tape
  double control_s = 900;  // one mark, measured with a receiver
};

// What the prediction assumes. Everything that matters is printed with the result.
struct Options {
  geometry::Camera camera;  // with what is known of it
  double sigma_px = 0.2;    // of an image coordinate, of ties and of targets
  int ties = 2000;          // points seen in two photos or more, spread evenly over that ground
  std::optional<Rtk> rtk;   // of each position that has no PhotoFix
  // Common to the flight: by so much the exposures are off the positions in time. Photos to come
  // are taken to be taken while the drone climbs.
  double delay_sigma_s = 0;
  std::optional<double> heading_sigma_deg;  // one compass, its error common to all photos
  std::optional<double> known_length_m;     // on the ground, centred on the foot
  double length_sigma_m = 0.005;
  int control_points = 0;  // far from the foot, at 80 % of the radius
  double control_sigma_m = 0.010;

  // Root mean squares of what the flight will be like.
  double wander_m =
      0;  // of photos to come about the line, each horizontal axis; 0: a straight line
  double tilt_deg = 1;    // of the camera, each of omega and phi; and of kappa about its mean
  double relief_m = 0.5;  // of the ground

  // The ground that matters is this far around the foot; default: what the shorter side of the
  // picture sees from the middle height.
  std::optional<double> radius_m;
  // Ties lie within this rectangle about the foot (half its sides, east and north); default: on
  // all ground that two photos see.
  std::optional<Eigen::Vector2d> field_half_m;

  // Sigma of plan (each axis) and of height that every ring within the radius shall reach: the
  // absolute sigmas where there is RTK, else the local ones.
  std::optional<double> goal_m;
  double ceiling_m = 150;  // no change flies higher
  double floor_m = 10;     // or lower
  // Where a drone in the air takes its photos by a plan: no change goes aside by less, or takes
  // photos in between.
  double least_aside_m = 0;
  bool photos_between = true;

  Costs costs;
  orient::Options adjustment;  // prior on tilts, and when a quantity is called unobservable
};

}  // namespace plumbline::plan
