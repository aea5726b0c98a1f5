// SPDX-License-Identifier: MIT
#pragma once

#include <utility>
#include <vector>

#include "edge/geometry/rotation.h"
#include "edge/orient/network/network.h"
#include "edge/orient/network/terms.h"

namespace plumbline::orient {

// What the makers of terms share.

// An angle's equal in [-pi, pi].
double wrapped(double angle_rad);

geometry::OmegaPhiKappa angles(const State& state, int slot);

// d(omega, phi, kappa) of a photo by its rotation increment.
Eigen::Matrix3d angles_by_increment(const State& state, int slot);

// first, first + 1, ...
std::vector<int> range(int first, int count);

// A term of one residual whose jacobian is yet to be filled in.
Term scalar_term(const char* group, std::vector<int> columns, double residual, double sigma);

}  // namespace plumbline::orient
