// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <vector>

#include "edge/orient/network/network.h"

namespace plumbline::orient {

// A combination of unknowns, in radians: what it moves in the images, over the focal length.
struct WeakDirection {
  Eigen::VectorXd gradient;  // by column of the reduced system
  double sigma_rad = 0;
};

// The principal axes of the error ellipsoid of camera and photos, the longest first. Metres,
// pixels and radians are made comparable by the angle that each moves the image by: positions over
// the flying height, interior parameters by their effect at the corner. `common` is the covariance
// of the reduced columns.
std::vector<WeakDirection> weak_directions(const Network& network, const State& state,
                                           const Eigen::MatrixXd& common);

}  // namespace plumbline::orient
