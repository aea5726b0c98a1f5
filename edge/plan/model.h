// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/base/result.h"
#include "edge/orient/network/network.h"
#include "edge/orient/problem.h"
#include "edge/plan/flight.h"
#include "edge/plan/ground.h"
#include "edge/plan/options.h"

namespace plumbline::plan {

// A flight as an adjustment would receive it, without any error in it: observations, positions and
// what else is known all agree with `truth`. Only sigmas matter. Every point is observed as one tie
// is; how many it stands for is kept beside.
struct Model {
  orient::Problem problem;
  orient::State truth;
  bool georeferenced = false;  // some photo has a position
  std::vector<Ring> rings;
  // By point of the problem, the foot of the climb first. Behind them, with 1 tie each, come the
  // ends of the known length and the control points.
  std::vector<GroundPoint> points;
};

// Camera poses on the way: tilts (and wander, for photos to come) follow a fixed pattern of the
// stated root mean squares.
std::vector<geometry::Pose> poses_of(const Flight& flight, const Options& options);

Model model_of(const Flight& flight, const Options& options, Detail detail);

// What is wrong with the flight or the options, in one sentence.
Status check(const Flight& flight, const Options& options);

}  // namespace plumbline::plan
