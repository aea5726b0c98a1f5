// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace plumbline::sim {

// How a drone goes up, aside and down again, metres and seconds.
struct ClimbPathOptions {
  double wait_s = 20;  // on the ground, before
  double climb_m_s = 2;
  double top_m = 92;
  double aside_m = 10;  // at the top, to the east; 0: none
  double aside_m_s = 2;
  double descent_m_s = 4;
  double gust_m_s = 0.1;      // RMS of the vertical velocity that nobody asked for
  double gust_s = 1;          // its correlation time
  double sideways_m_s = 0.1;  // the same in each horizontal axis
  double bobs_per_s = 0;      // how often the pilot goes back down for a moment, in the climb
  double pauses_per_s = 0;    // how often the pilot stops for 4 s, in the climb
  double landed_s = 8;        // on the ground, after
};

// Where the antenna is, from the ground to the ground: what the pilot asks for, followed with a lag
// of 0.4 s and at most 2 m/s2, and gusts (an Ornstein-Uhlenbeck velocity). The same seed gives the
// same path.
class ClimbPath {
 public:
  ClimbPath(const ClimbPathOptions& options, std::uint64_t seed);

  // East, north, up about the take-off point. Before and after it stands still.
  Eigen::Vector3d at(double seconds) const;

  double duration_s() const;

 private:
  std::vector<Eigen::Vector3d> places_m_;  // every kStep_s
};

}  // namespace plumbline::sim
