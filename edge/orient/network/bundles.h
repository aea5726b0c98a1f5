// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <vector>

#include "edge/geometry/brown.h"
#include "edge/orient/network/network.h"

namespace plumbline::orient {

// Points of one group are worked on side by side, one in each lane, so that the processor's vector
// unit does the arithmetic of several at once. Which points share a bundle follows from the
// network alone, so that the same problem gives the same bits.
inline constexpr int kLanes = 8;
using Lanes = Eigen::Array<double, kLanes, 1>;
using Lanes3 = std::array<Lanes, 3>;

// The rays of one photo to the points of a bundle.
struct BundleRays {
  Lanes u = Lanes::Zero(), v = Lanes::Zero();  // measured, px
  Lanes information = Lanes::Zero();           // 1 / sigma^2; 0 where the ray is not used
  Lanes rows = Lanes::Zero();                  // from the middle row to the one measured
  int slot = 0;
};

// Up to kLanes points of a group; the lanes beyond `count` repeat the first point without weight.
struct Bundle {
  int group = 0;  // of Network::groups
  int count = 0;
  std::array<int, kLanes> point{};
  int first_ray = 0;  // of Bundles::rays, as many as the group has slots
};

// What minimising reads of a network's rays, in the order in which it reads them.
struct Bundles {
  std::vector<Bundle> bundles;   // group by group
  std::vector<BundleRays> rays;  // bundle by bundle
};

Bundles bundles_of(const Network& network);

// The points of a bundle at `state`, by coordinate.
Lanes3 points_of(const Bundle& bundle, const State& state);

// The rays of a bundle to one photo at one state: computed minus measured pixel (px), and what the
// derivatives need.
struct SeenRays {
  Lanes3 from_centre;  // ground frame, m
  Lanes inverse_depth;
  geometry::Distorted<Lanes> distorted;
  Lanes u, v;                            // residuals
  Eigen::Array<bool, kLanes, 1> hidden;  // used, but not to be projected
  Lanes information;                     // that of the rays, 0 where hidden
};
SeenRays seen(const Network& network, const BundleRays& rays, const Lanes3& points,
              const State& state);

inline constexpr int kRayColumns = kShared + Layout::kPose;

using PixelLanes = geometry::ByPixel<Lanes>;

// Their derivatives times `scale`, by shared columns, pose and point. Of the shared columns only
// those that are adjusted and that rays know of (not kDelay) are filled in.
struct LinearRays {
  std::array<PixelLanes, kRayColumns> by_common;
  std::array<PixelLanes, 3> by_point;
};
void differentiate(const Network& network, const SeenRays& rays, const BundleRays& measured,
                   const State& state, const Lanes& scale, LinearRays& out);

}  // namespace plumbline::orient
