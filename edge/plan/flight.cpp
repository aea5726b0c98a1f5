// SPDX-License-Identifier: MIT
#include "edge/plan/flight.h"

#include <algorithm>
#include <cmath>

#include "edge/base/median.h"

namespace plumbline::plan {
namespace {

constexpr double kSameHeightM = 0.5;
constexpr double kUsualStepM = 5;

std::vector<double> sorted_heights(const Flight& flight) {
  std::vector<double> heights;
  for (const Eigen::Vector3d& place : flight.all_m()) heights.push_back(place.z());
  std::sort(heights.begin(), heights.end());
  return heights;
}

}  // namespace

std::optional<Climb> named_climb(const std::string& name) {
  if (name == "paper") return Climb{70, 90, 5, {}};
  if (name == "standard") return Climb{30, 90, 5, {10}};
  if (name == "ice") return Climb{10, 60, 2.5, {5}};
  return std::nullopt;
}

std::vector<Eigen::Vector3d> Flight::all_m() const {
  std::vector<Eigen::Vector3d> all = taken_m;
  all.insert(all.end(), ahead_m.begin(), ahead_m.end());
  return all;
}

Status check(const Climb& climb) {
  constexpr double kMostSteps = 200;
  if (!(climb.from_m > 0) || !std::isfinite(climb.to_m)) {
    return Error{"The heights of the climb must be numbers above 0, in metres."};
  }
  if (climb.to_m < climb.from_m) {
    return Error{"The climb ends below its start: let --to be at least --from."};
  }
  if (!(climb.step_m > 0) || (climb.to_m - climb.from_m) / climb.step_m > kMostSteps) {
    return Error{"The step must be above 0, and the climb have no more than 200 of them."};
  }
  for (const double leg_m : climb.side_steps_m) {
    if (!(leg_m >= 0 && std::isfinite(leg_m))) {
      return Error{"A side-step must be a number of metres from 0 on."};
    }
  }
  return Done{};
}

Flight flight_of(const Climb& climb) {
  Flight flight;
  flight.foot_m = Eigen::Vector2d(0, 0);
  const double steps = std::floor((climb.to_m - climb.from_m) / climb.step_m + 1e-9);
  for (double k = 0; k <= steps; ++k) {
    flight.ahead_m.emplace_back(0, 0, climb.from_m + k * climb.step_m);
  }
  if (climb.to_m - flight.ahead_m.back().z() > 1e-6) flight.ahead_m.emplace_back(0, 0, climb.to_m);
  Eigen::Vector3d place(0, 0, climb.to_m), direction(1, 0, 0);
  for (const double leg_m : climb.side_steps_m) {
    if (leg_m == 0) continue;
    place += leg_m * direction;
    direction = {-direction.y(), direction.x(), 0};
    flight.ahead_m.push_back(place);
  }
  return flight;
}

Eigen::Vector2d foot_of(const Flight& flight) {
  if (flight.foot_m) return *flight.foot_m;
  std::vector<double> east, north;
  for (const Eigen::Vector3d& place : flight.all_m()) {
    east.push_back(place.x());
    north.push_back(place.y());
  }
  return {upper_median(std::move(east)), upper_median(std::move(north))};
}

double highest_m(const Flight& flight) { return sorted_heights(flight).back(); }

double lowest_m(const Flight& flight) { return sorted_heights(flight).front(); }

double usual_step_m(const Flight& flight) {
  const std::vector<double> heights = sorted_heights(flight);
  std::vector<double> steps;
  for (std::size_t i = 1; i < heights.size(); ++i) {
    const double step = heights[i] - heights[i - 1];
    if (step > kSameHeightM) steps.push_back(step);
  }
  return steps.empty() ? kUsualStepM : upper_median(std::move(steps));
}

}  // namespace plumbline::plan
