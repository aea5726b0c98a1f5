// SPDX-License-Identifier: MIT
#include "edge/orient/findings/no_solution.h"

#include <string>
#include <vector>

#include "edge/base/median.h"
#include "edge/orient/findings/formatted.h"
#include "edge/orient/network/rays.h"

namespace plumbline::orient {
namespace {

// Fewer points fix no photo beside another.
constexpr int kLeastPoints = 4;

// Points by what became of them.
struct Tally {
  int in_two_photos = 0;
  int undetermined = 0;  // by their own rays known too badly to be a measurement
  int used = 0;          // two good rays or more
  Agreement agreement;
};

Tally tally(const Network& network) {
  Tally out;
  for (int p = 0; p < network.points(); ++p) {
    const int rays = network.first_ray[at(p) + 1] - network.first_ray[at(p)];
    if (rays < 2) continue;
    ++out.in_two_photos;
    const int used = used_rays(network, p);
    if (used >= 2) ++out.used;
    if (network.undetermined[at(p)]) {
      ++out.undetermined;
    } else {
      out.agreement.rays += rays;
      out.agreement.used += used;
    }
  }
  return out;
}

std::string of_all(int count, int all) {
  return std::to_string(count) + " of " + std::to_string(all);
}

// Of a picture so wide, in pixels: the rest are slips of units.
bool is_focal_length(double f, int width_px) {
  constexpr double kWidest = 0.2, kNarrowest = 50;
  return f > kWidest * width_px && f < kNarrowest * width_px;
}

bool stands_below_ground(const Network& network, const State& state) {
  std::vector<double> ground, stations;
  for (const Ray& ray : network.rays) ground.push_back(state.points[at(ray.point)].z());
  for (const geometry::Pose& pose : state.poses) stations.push_back(pose.centre_m.z());
  return !stations.empty() && !ground.empty() && upper_median(stations) < upper_median(ground);
}

}  // namespace

Agreement agreement(const Network& network) { return tally(network).agreement; }

Error contradiction(const Network& network) {
  const geometry::Camera& camera = network.problem->camera;
  const double f = camera.interior[geometry::kFocalLength];
  const Agreement found = agreement(network);
  const std::string few = "No solution: only " + of_all(found.used, found.rays) +
                          " image measurements agree with each other and with what is known. ";
  if (!is_focal_length(f, camera.width_px)) {
    return {few +
            formatted("The camera's focal length of %.6g px fits no picture of %d px; give it "
                      "in pixels.",
                      f, camera.width_px)};
  }
  return {few +
          "Check the names of photos and points, the pixels (u right, v down), the camera, whether "
          "positions, lengths and control are in metres, and whether a sigma is too small."};
}

Error no_solution(const Network& network, const State& state) {
  const Tally t = tally(network);
  if (t.in_two_photos < kLeastPoints) {
    return {"No solution: only " + std::to_string(t.in_two_photos) +
            " points are seen in two photos or more; measure more points that photos share."};
  }
  if (t.used < kLeastPoints && 2 * t.undetermined > t.in_two_photos) {
    return {"No solution: " + of_all(t.undetermined, t.in_two_photos) +
            " points are known too badly by their rays to be measured. The photos stand too close "
            "together, or sigma_px is too large."};
  }
  if (stands_below_ground(network, state)) {
    return {
        "No solution: by what is known the photos were taken from below the ground that they show. "
        "Heights count upwards, and control points lie on the ground."};
  }
  if (t.used < kLeastPoints || t.agreement.is_minority()) return contradiction(network);
  return {
      "No solution: what is given leaves some of the unknowns undetermined, or its sigmas differ "
      "too much in size to be computed with. Check the sigmas and covariances of positions, "
      "lengths and camera, and whether all points lie on one line."};
}

}  // namespace plumbline::orient
