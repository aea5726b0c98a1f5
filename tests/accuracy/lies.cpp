// SPDX-License-Identifier: MIT
#include "tests/accuracy/lies.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <random>
#include <set>
#include <vector>

#include "edge/base/index.h"
#include "edge/base/parallel.h"
#include "edge/base/units.h"

namespace plumbline::orient::testing {
namespace {

Eigen::Vector3d gaussian(std::mt19937_64& random) {
  std::normal_distribution<double> normal;
  const double e = normal(random), n = normal(random), u = normal(random);
  return {e, n, u};
}

double nees(const MadeFlight& flight, const Solution& solution) {
  std::vector<int> measured;
  for (int p = 0; p < flight.targets; ++p) {
    if (solution.points[at(p)].measured) measured.push_back(p);
  }
  Eigen::VectorXd d(static_cast<Eigen::Index>(3 * measured.size()));
  for (std::size_t i = 0; i < measured.size(); ++i) {
    d.segment<3>(static_cast<Eigen::Index>(3 * i)) =
        solution.points[at(measured[i])].in_enu_m - flight.points[at(measured[i])];
  }
  return d.dot(solution.covariances->joint(measured).ldlt().solve(d)) /
         static_cast<double>(d.size());
}

std::set<std::string> accused(const Solution& solution) {
  std::set<std::string> names;
  for (const Blunder& blunder : solution.summary.blunders)
    names.insert(blunder.kind + " " + blunder.subject);
  return names;
}

struct Lie {
  std::set<std::string> accused;  // kind and subject
  bool detectable = true;
};

using Prepare = std::function<void(std::mt19937_64&, MadeFlight&)>;
using Tell = std::function<Lie(const Solution& clean, std::mt19937_64&, MadeFlight&)>;

Lie move_stations(const Solution& clean, double size_m, int wrong, std::mt19937_64& random,
                  MadeFlight& flight) {
  Lie lie;
  std::vector<std::size_t> order(flight.problem.photos.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::shuffle(order.begin(), order.end(), random);
  for (int k = 0; k < wrong; ++k) {
    const std::size_t photo = order[at(k)];
    const Eigen::Vector3d error = size_m * gaussian(random).normalized();
    flight.problem.photos[photo].station->antenna_in_enu_m += error;
    lie.accused.insert("station " + flight.problem.photos[photo].name);
    const auto& check = clean.photos[photo].station_check;
    lie.detectable =
        lie.detectable && check && error.dot(check->detectability * error) > check->noncentrality;
  }
  return lie;
}

// Of the kinds that were lied about, what was said.
std::set<std::string> said_of(const Lie& lie, const Solution& solution) {
  std::set<std::string> kinds, said;
  for (const std::string& name : lie.accused) kinds.insert(name.substr(0, name.find(' ')));
  for (const std::string& name : accused(solution)) {
    if (kinds.contains(name.substr(0, name.find(' ')))) said.insert(name);
  }
  return said;
}

void count_lied(const Lie& lie, const MadeFlight& flight, const Solution& solution,
                LieTally& tally) {
  if (!lie.detectable) {
    ++tally.below;
    return;
  }
  ++tally.detectable;
  const auto said = said_of(lie, solution);
  const bool found =
      std::includes(said.begin(), said.end(), lie.accused.begin(), lie.accused.end());
  tally.found += found ? 1 : 0;
  tally.unseen += accused(solution).empty() ? 1 : 0;
  if (said != lie.accused) return;
  ++tally.named;
  if (!(solution.summary.common.azimuth_rad < kRadPerDeg)) return;
  ++tally.compared;
  tally.lied_nees += nees(flight, solution);
}

void finish(LieTally& tally) {
  tally.clean_nees /= std::max(1, tally.flights);
  tally.lied_nees /= std::max(1, tally.compared);
}

// One flight, clean and lied to.
LieTally tell_once(const FlightPlan& plan, std::uint64_t seed, const Prepare& prepare,
                   const Tell& lie_in) {
  LieTally tally;
  MadeFlight flight = make_flight(plan, seed);
  std::mt19937_64 random(seed ^ 0x9e3779b97f4a7c15U);
  prepare(random, flight);
  const auto clean = adjust(flight.problem, {});
  if (!clean) {
    tally.failed = 1;
    return tally;
  }
  tally.flights = 1;
  tally.false_alarms = clean->summary.blunders.empty() ? 0 : 1;
  tally.unchecked = clean->summary.unchecked.empty() ? 0 : 1;
  tally.clean_nees = nees(flight, *clean);
  const Lie lie = lie_in(*clean, random, flight);
  if (lie.accused.empty()) return tally;
  const auto solution = adjust(flight.problem, {});
  if (!solution) {
    tally.failed = 1;
    return tally;
  }
  count_lied(lie, flight, *solution, tally);
  return tally;
}

void add(const LieTally& other, LieTally& sum) {
  sum.flights += other.flights;
  sum.failed += other.failed;
  sum.false_alarms += other.false_alarms;
  sum.detectable += other.detectable;
  sum.named += other.named;
  sum.found += other.found;
  sum.unseen += other.unseen;
  sum.below += other.below;
  sum.unchecked += other.unchecked;
  sum.clean_nees += other.clean_nees;
  sum.compared += other.compared;
  sum.lied_nees += other.lied_nees;
}

LieTally tell(const FlightPlan& plan, const LieTrials& trials, const Prepare& prepare,
              const Tell& lie_in) {
  std::vector<LieTally> tallies(at(trials.trials));
  parallel_for(trials.trials, trials.threads, [&](int i) {
    const std::uint64_t seed = trials.first_seed + static_cast<std::uint64_t>(i);
    tallies[at(i)] = tell_once(plan, seed, prepare, lie_in);
  });
  LieTally sum;
  for (const LieTally& tally : tallies) add(tally, sum);
  finish(sum);
  return sum;
}

// As far apart as a field allows: each of another tenth of the points, by their place in the list.
void add_lengths(std::mt19937_64& random, MadeFlight& flight) {
  std::normal_distribution<double> normal(0, 0.002);
  for (int i = 0; i < 5; ++i) {
    const double metres = (flight.points[at(2 * i + 1)] - flight.points[at(2 * i)]).norm();
    flight.problem.lengths.push_back({2 * i, 2 * i + 1, metres + normal(random), 0.002});
  }
}

void add_control(std::mt19937_64& random, MadeFlight& flight) {
  constexpr double kSigmaM = 0.005;
  for (int i = 0; i < 6; ++i) {
    flight.problem.control.push_back({3 * i, flight.points[at(3 * i)] + kSigmaM * gaussian(random),
                                      kSigmaM * kSigmaM * Eigen::Matrix3d::Identity()});
  }
}

void nothing(std::mt19937_64& /*random*/, MadeFlight& /*flight*/) {}

int chosen(std::mt19937_64& random, int count) {
  return std::uniform_int_distribution<int>(0, count - 1)(random);
}

std::string pair_of(const Problem& problem, int a, int b) {
  const auto [first, second] = std::minmax(a, b);
  return "exchanged_names " + problem.point_names[at(first)] + " and " +
         problem.point_names[at(second)];
}

Lie exchange_rays(std::mt19937_64& random, MadeFlight& flight) {
  auto& observations = flight.problem.observations;
  const int first = chosen(random, static_cast<int>(observations.size()));
  Observation& a = observations[at(first)];
  for (int k = first + 1; k < static_cast<int>(observations.size()); ++k) {
    Observation& b = observations[at(k)];
    if (b.photo != a.photo || (b.pixel - a.pixel).norm() < 20) continue;
    std::swap(a.point, b.point);
    return {{pair_of(flight.problem, a.point, b.point)}};
  }
  return {};
}

}  // namespace

LieTally false_stations(const FlightPlan& plan, double size_m, int wrong, const LieTrials& trials) {
  return tell(plan, trials, nothing,
              [&](const Solution& clean, std::mt19937_64& random, MadeFlight& flight) {
                return move_stations(clean, size_m, wrong, random, flight);
              });
}

LieTally wrong_length(const FlightPlan& plan, double size_m, const LieTrials& trials) {
  return tell(
      plan, trials, add_lengths,
      [&](const Solution& /*clean*/, std::mt19937_64& random, MadeFlight& flight) {
        Length& length = flight.problem.lengths[at(chosen(random, 5))];
        length.metres += chosen(random, 2) == 0 ? size_m : -size_m;
        const auto& names = flight.problem.point_names;
        return Lie{{"length " + names[at(length.point_a)] + " to " + names[at(length.point_b)]}};
      });
}

LieTally wrong_control(const FlightPlan& plan, double size_m, const LieTrials& trials) {
  return tell(plan, trials, add_control,
              [&](const Solution& /*clean*/, std::mt19937_64& random, MadeFlight& flight) {
                Control& control = flight.problem.control[at(chosen(random, 6))];
                control.in_enu_m += size_m * gaussian(random).normalized();
                return Lie{{"control " + flight.problem.point_names[at(control.point)]}};
              });
}

LieTally exchanged_control(const FlightPlan& plan, const LieTrials& trials) {
  return tell(plan, trials, add_control,
              [&](const Solution& /*clean*/, std::mt19937_64& random, MadeFlight& flight) {
                Control& a = flight.problem.control[at(chosen(random, 3))];
                Control& b = flight.problem.control[at(3 + chosen(random, 3))];
                std::swap(a.in_enu_m, b.in_enu_m);
                return Lie{{pair_of(flight.problem, a.point, b.point)}};
              });
}

LieTally exchanged_rays(const FlightPlan& plan, const LieTrials& trials) {
  return tell(plan, trials, nothing,
              [](const Solution& /*clean*/, std::mt19937_64& random, MadeFlight& flight) {
                return exchange_rays(random, flight);
              });
}

LieTally wrong_focal_length(const FlightPlan& plan, double share, const LieTrials& trials) {
  return tell(plan, trials, nothing,
              [&](const Solution& /*clean*/, std::mt19937_64& /*random*/, MadeFlight& flight) {
                flight.problem.camera.interior[geometry::kFocalLength] *= 1 + share;
                return Lie{{"focal_length focal length"}};
              });
}

std::string in_words(const LieTally& t) {
  char line[400];
  std::snprintf(line, sizeof line,
                "flights %d failed %d | false alarms %d | detectable %d named %d found %d unseen %d"
                " | below %d | unchecked %d | nees clean %.3f lied %.3f",
                t.flights, t.failed, t.false_alarms, t.detectable, t.named, t.found, t.unseen,
                t.below, t.unchecked, t.clean_nees, t.lied_nees);
  return line;
}

}  // namespace plumbline::orient::testing
