// SPDX-License-Identifier: MIT
#include "edge/orient/paper/priors.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace plumbline::orient::paper {
namespace {

using geometry::Camera;
using geometry::InteriorVector;

InteriorVector declared(const Priors& priors, const Camera& camera) {
  const double f = priors.focal_length * camera.interior[geometry::kFocalLength];
  const double centre = priors.principal_point * camera.width_px;
  InteriorVector sigma;
  sigma << f, centre, centre, priors.affinity, priors.affinity, priors.radial, priors.radial,
      priors.radial, priors.tangential, priors.tangential;
  return sigma;
}

}  // namespace

Camera camera_with(const Priors& priors, const Camera& camera) {
  Camera out = camera;
  const InteriorVector limit = declared(priors, camera);
  for (int i = 0; i < geometry::kInteriorCount; ++i) {
    const double known =
        camera.covariance ? std::sqrt((*camera.covariance)(i, i)) : camera.sigma[i];
    out.sigma[i] = std::isfinite(known) ? std::min(known, limit[i]) : limit[i];
  }
  out.covariance.reset();
  return out;
}

std::string in_words(const Priors& priors, const Camera& camera) {
  const InteriorVector s = camera_with(priors, camera).sigma;
  char text[400];
  std::snprintf(text, sizeof text,
                "ground flat to %.2g m, tilts within %.2g degrees, f to %.2g %%, principal point "
                "to %.3g px, affinity and skew to %.2g, radial distortion k1 to %.2g, tangential "
                "to %.2g",
                priors.ground_flat_m, priors.tilt_deg,
                100 * s[geometry::kFocalLength] / camera.interior[geometry::kFocalLength],
                s[geometry::kPrincipalU], s[geometry::kAffinity], s[geometry::kRadial1],
                s[geometry::kTangential1]);
  return text;
}

}  // namespace plumbline::orient::paper
