// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "edge/orient/network/network.h"
#include "edge/orient/network/normal_equations.h"

namespace plumbline::orient {

// Squared residual of a ray in its sigmas; infinite where it cannot be projected.
double squared_sigmas(const Ray& ray, const State& state);

// Rejects rays beyond `sigmas`, takes back those that have come within, and drops points left with
// one ray that nothing else holds. Returns how many rays changed sides.
int reject_rays(Network& network, const State& state, double sigmas);

// The point takes no more part, whatever its rays would say later.
void drop_for_good(Network& network, int point);

// Drops for good the points whose rays, poses given, leave them a sigma beyond `limit_m`. Returns
// how many.
int drop_undetermined(Network& network, const NormalEquations& equations, double limit_m);

// Drops for good the points that have come to lie at a camera that sees them, nearer than a share
// of the flying height: there every ray of that camera fits, and no step leads away. Returns how
// many.
int drop_points_at_cameras(Network& network, const State& state);

// Before a stage: a point that mismatches have thrown far above or below the ground goes back to
// the median of its rays' intersections with the ground plane; left near its cameras it would
// block every step.
void replant_wild_points(const Network& network, State& state);

// The same for every point, where photos were put somewhere else.
void replant_points(const Network& network, State& state);

// Before a stage: sets aside rays that cannot be projected at all.
void drop_unprojectable(Network& network, const State& state);

}  // namespace plumbline::orient
