// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <array>
#include <string>
#include <vector>

#include "edge/orient/network/network.h"

namespace plumbline::orient {

// One linearised term on the columns of the reduced system: everything known but the image rays.
// residual = computed - known; information = inverse covariance.
struct Term {
  std::string group;  // gnss, heading, attitude, camera, lengths, control, datum
  std::vector<int> columns;
  Eigen::VectorXd residual;
  Eigen::MatrixXd jacobian;  // residual by columns
  Eigen::MatrixXd information;
  int subject = -1;  // lengths, control: its index in the problem
};

// What holds the network in space.
enum class Datum {
  kFree,   // the photos alone: stations, headings, lengths and control are left aside
  kKnown,  // everything that is known
};

// Holds one linear combination of the reduced columns at a distance from a place: a probe.
struct Pin {
  Eigen::VectorXd gradient;  // by column
  State from;
  double value = 0;
  double sigma = 0;
};

struct TermOptions {
  Datum datum = Datum::kKnown;
  double tilt_sigma_rad = 0;
  bool bridle_interior = false;  // the first, crude stage holds a free camera near its start
  // How far what is known is believed: 1 = as stated, towards 0 = not, 0 = rejected. By slot, and
  // by index in the problem; empty: all as stated.
  std::vector<double> station_weights;
  std::vector<double> length_weights;
  std::vector<double> control_weights;
  // Parameters of the interior whose calibration is not believed: they are free.
  std::array<bool, geometry::kInteriorCount> interior_freed{};
  std::vector<Pin> pins;
};

// 1 where `weights` is empty.
double weight_of(const std::vector<double>& weights, int index);

// The camera before the adjustment, as far as it is believed.
geometry::Camera believed_camera(const Network& network, const TermOptions& options);

// Gauge freedoms of the network that nothing known removes.
struct DatumDefect {
  bool translation = false;
  bool azimuth = false;
  bool scale = false;
};
DatumDefect datum_defect(const Network& network, const TermOptions& options);

std::vector<Term> linearised_terms(const Network& network, const State& state, const State& start,
                                   const TermOptions& options);

// How one place of the network lies from another, by column of the reduced system: differences,
// rotations as rotation vectors.
Eigen::VectorXd pin_displacement(const Network& network, const State& from, const State& to);

// Sum of residual' information residual.
double cost_of(const std::vector<Term>& terms);

// Covariance of all stations of the network together (3m x 3m, order of `station_slots`): the
// white part of each over its weight, lever arm, common offset and Gauss-Markov part.
std::vector<int> station_slots(const Network& network, const TermOptions& options);
Eigen::MatrixXd station_covariance(const Network& network, const State& state,
                                   const TermOptions& options);

}  // namespace plumbline::orient
