// SPDX-License-Identifier: MIT
#include "edge/orient/paper/relative.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

#include "edge/base/index.h"
#include "edge/base/units.h"
#include "edge/geometry/rotation.h"
#include "edge/orient/paper/coplanarity.h"

namespace plumbline::orient::paper {
namespace {

using geometry::kInteriorCount;

constexpr int kOfPhoto = 5;  // rotation increment 3, B_x, B_y
constexpr int kLeastConditions = 5;
constexpr int kMaxRelativeSteps = 500;
constexpr double kRelativeTolerance = 1e-10;
constexpr double kMostLambda = 1e10;

struct Pair {
  int photo = 0;
  std::vector<PairObservation> seen;
};

struct Unknowns {
  geometry::InteriorVector interior;
  std::vector<geometry::Pose> poses;  // by pair
};

struct RelativeEquations {
  Eigen::MatrixXd normal;
  Eigen::VectorXd gradient;
  double cost = 0;
  double sampson_squares = 0;
  bool whole = true;  // false: a pixel has no ray
};

std::map<int, const Observation*> seen_in(const Problem& problem, int photo) {
  std::map<int, const Observation*> seen;
  for (const Observation& o : problem.observations) {
    if (o.photo == photo) seen[o.point] = &o;
  }
  return seen;
}

std::vector<Pair> pairs_with(const Problem& problem, int lowest) {
  const auto first = seen_in(problem, lowest);
  std::vector<Pair> pairs;
  for (int photo = 0; photo < static_cast<int>(problem.photos.size()); ++photo) {
    if (photo == lowest) continue;
    Pair pair{photo, {}};
    for (const auto& [point, o] : seen_in(problem, photo)) {
      const auto other = first.find(point);
      if (other == first.end()) continue;
      pair.seen.push_back({other->second->pixel, o->pixel, other->second->sigma_px, o->sigma_px});
    }
    pairs.push_back(std::move(pair));
  }
  return pairs;
}

// The least squares of all pairs together.
class Orientation {
 public:
  Orientation(const std::vector<Pair>& pairs, const geometry::Camera& camera,
              const Heights& heights, const Priors& priors)
      : pairs_(pairs),
        camera_(camera),
        heights_(heights),
        tilt_rad_(std::numbers::sqrt2 * priors.tilt_deg * kRadPerDeg) {}

  RelativeEquations linearise(const Unknowns& at_u) const {
    RelativeEquations out;
    const auto size = static_cast<Eigen::Index>(kInteriorCount + kOfPhoto * pairs_.size());
    out.normal.setZero(size, size);
    out.gradient.setZero(size);
    for (std::size_t k = 0; k < pairs_.size(); ++k) add_pair(at_u, k, out);
    add_camera(at_u, out);
    for (std::size_t k = 0; k < pairs_.size(); ++k) add_photo(at_u, k, out);
    return out;
  }

  Unknowns moved(const Unknowns& from, const Eigen::VectorXd& step) const {
    Unknowns to = from;
    to.interior += step.head<kInteriorCount>();
    for (std::size_t k = 0; k < pairs_.size(); ++k) {
      const Eigen::Matrix<double, kOfPhoto, 1> d = step.segment<kOfPhoto>(column(k));
      to.poses[k].ground_from_photo =
          geometry::rotation_by(d.head<3>()) * from.poses[k].ground_from_photo;
      to.poses[k].centre_m.head<2>() += d.tail<2>();
    }
    return to;
  }

 private:
  static Eigen::Index column(std::size_t pair) {
    return kInteriorCount + kOfPhoto * static_cast<Eigen::Index>(pair);
  }

  void add_pair(const Unknowns& u, std::size_t k, RelativeEquations& out) const {
    for (const PairObservation& seen : pairs_[k].seen) {
      const auto c = coplanarity(u.interior, u.poses[k], seen);
      if (!c) {
        out.whole = false;
        continue;
      }
      Eigen::RowVectorXd row = Eigen::RowVectorXd::Zero(out.gradient.size());
      row.head<kInteriorCount>() = c->by_interior;
      row.segment<3>(column(k)) = c->by_rotation;
      row.segment<2>(column(k) + 3) = c->by_base.head<2>();
      out.normal += row.transpose() * row;
      out.gradient += row.transpose() * c->residual;
      out.cost += c->residual * c->residual;
      out.sampson_squares += c->sampson_px * c->sampson_px;
    }
  }

  static void add_prior(RelativeEquations& out, Eigen::Index i, double residual, double sigma) {
    out.normal(i, i) += 1 / (sigma * sigma);
    out.gradient[i] += residual / (sigma * sigma);
    out.cost += residual * residual / (sigma * sigma);
  }

  // A parameter held fixed keeps its value: an unknown without derivatives.
  void add_camera(const Unknowns& u, RelativeEquations& out) const {
    for (int i = 0; i < kInteriorCount; ++i) {
      if (camera_.sigma[i] > 0) {
        add_prior(out, i, u.interior[i] - camera_.interior[i], camera_.sigma[i]);
      } else {
        out.normal.row(i).setZero();
        out.normal.col(i).setZero();
        out.normal(i, i) = 1;
        out.gradient[i] = 0;
      }
    }
  }

  // Tilt against photo 1, and the climb against its axis.
  void add_photo(const Unknowns& u, std::size_t k, RelativeEquations& out) const {
    const auto angles = geometry::angles_of(u.poses[k].ground_from_photo);
    const Eigen::Matrix3d by = geometry::angles_by_ground_increment(angles);
    const Eigen::Vector2d tilt(angles.omega_rad, angles.phi_rad);
    const double weight = 1 / (tilt_rad_ * tilt_rad_);
    for (int i = 0; i < 2; ++i) {
      out.normal.block<3, 3>(column(k), column(k)) += weight * by.row(i).transpose() * by.row(i);
      out.gradient.segment<3>(column(k)) += weight * tilt[i] * by.row(i).transpose();
      out.cost += weight * tilt[i] * tilt[i];
    }
    const double slant_m = tilt_rad_ * std::max(heights_.base_z_m[at(pairs_[k].photo)], 1e-3);
    for (int i = 0; i < 2; ++i) add_prior(out, column(k) + 3 + i, u.poses[k].centre_m[i], slant_m);
  }

  const std::vector<Pair>& pairs_;
  const geometry::Camera& camera_;
  const Heights& heights_;
  double tilt_rad_;
};

// The turn about the vertical that the known length shows between photo 1 and photo i.
double turn_between(const Problem& problem, const Length& length, int first, int photo) {
  const auto direction = [&](int in) {
    const auto seen = seen_in(problem, in);
    const Eigen::Vector2d along = seen.at(length.point_b)->pixel - seen.at(length.point_a)->pixel;
    return std::atan2(-along.y(), along.x());  // v runs down
  };
  return direction(first) - direction(photo);
}

Unknowns start_of(const Problem& problem, const geometry::Camera& camera, const Heights& heights,
                  const Length& length, const std::vector<Pair>& pairs) {
  Unknowns start{camera.interior, {}};
  for (const Pair& pair : pairs) {
    geometry::Pose pose;
    pose.centre_m = {0, 0, heights.base_z_m[at(pair.photo)]};
    pose.ground_from_photo = geometry::ground_from_photo(
        {0, 0, turn_between(problem, length, heights.lowest, pair.photo)});
    start.poses.push_back(pose);
  }
  return start;
}

struct Settled {
  Unknowns unknowns;
  double sampson_squares = 0;
  int iterations = 0;
  bool converged = false;
};

// Levenberg 1944, Marquardt 1963.
Settled minimise(const Orientation& orientation, const Unknowns& start) {
  Settled out{start, 0, 0, false};
  RelativeEquations here = orientation.linearise(start);
  double lambda = 1e-3;
  while (!out.converged && out.iterations < kMaxRelativeSteps && lambda < kMostLambda) {
    ++out.iterations;
    Eigen::MatrixXd damped = here.normal;
    damped.diagonal() *= 1 + lambda;
    const Eigen::VectorXd step = -damped.ldlt().solve(here.gradient);
    const Unknowns trial = orientation.moved(out.unknowns, step);
    const RelativeEquations there = orientation.linearise(trial);
    const bool better = there.whole && there.cost < here.cost;
    const double change = std::abs(here.cost - there.cost);
    out.converged = there.whole && change <= kRelativeTolerance * (1 + here.cost);
    lambda = better ? std::max(lambda / 8, 1e-12) : 8 * lambda;
    if (!better) continue;
    out.unknowns = trial;
    here = there;
  }
  out.sampson_squares = here.sampson_squares;
  return out;
}

std::optional<Error> too_few(const Problem& problem, const std::vector<Pair>& pairs, int lowest) {
  for (const Pair& pair : pairs) {
    if (static_cast<int>(pair.seen.size()) >= kLeastConditions) continue;
    return Error{"Photo " + problem.photos[at(pair.photo)].name + " shares only " +
                 std::to_string(pair.seen.size()) + " points with the lowest photo, " +
                 problem.photos[at(lowest)].name + "; relative orientation needs " +
                 std::to_string(kLeastConditions) + " or more."};
  }
  return std::nullopt;
}

}  // namespace

Result<RelativeOrientation> relative_orientation(const Problem& problem,
                                                 const geometry::Camera& camera,
                                                 const Heights& heights, const Length& length,
                                                 const Priors& priors) {
  const std::vector<Pair> pairs = pairs_with(problem, heights.lowest);
  if (const auto error = too_few(problem, pairs, heights.lowest)) return *error;
  const Orientation orientation(pairs, camera, heights, priors);
  const Settled settled = minimise(orientation, start_of(problem, camera, heights, length, pairs));
  RelativeOrientation out;
  out.interior = settled.unknowns.interior;
  out.poses.resize(problem.photos.size());
  for (std::size_t k = 0; k < pairs.size(); ++k) {
    out.poses[at(pairs[k].photo)] = settled.unknowns.poses[k];
    out.conditions += static_cast<int>(pairs[k].seen.size());
  }
  out.unknowns = static_cast<int>((camera.sigma.array() > 0).count()) +
                 kOfPhoto * static_cast<int>(pairs.size());
  out.rms_px = std::sqrt(settled.sampson_squares / std::max(out.conditions, 1));
  out.iterations = settled.iterations;
  out.converged = settled.converged;
  return out;
}

}  // namespace plumbline::orient::paper
