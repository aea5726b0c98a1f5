// SPDX-License-Identifier: MIT
#include "edge/orient/paper/final_adjustment.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "edge/base/index.h"
#include "edge/base/units.h"
#include "edge/orient/findings/solution_of.h"
#include "edge/orient/network/minimise.h"
#include "edge/orient/three_point_frame.h"

namespace plumbline::orient::paper {
namespace {

constexpr double kHeldPointM = 1e-3;
constexpr double kUnknownM = 100;
constexpr double kTolerance = 1e-12;
constexpr int kMaxIterations = 1000;
constexpr int kMaxRounds = 6;
constexpr double kSigmaSettled = 0.002;

// Photos without what GNSS and compass say of them: the published procedure knows neither.
Problem bare_problem(const FramedCase& framed) {
  Problem problem;
  problem.camera = framed.camera;
  problem.point_names = framed.given.point_names;
  problem.observations = framed.given.observations;
  for (const Photo& photo : framed.given.photos) {
    problem.photos.emplace_back();
    problem.photos.back().name = photo.name;
  }
  return problem;
}

Problem resection_problem(const FramedCase& framed, const std::vector<Eigen::Vector3d>& points) {
  Problem problem = bare_problem(framed);
  for (std::size_t p = 0; p < points.size(); ++p) {
    problem.control.push_back(
        {static_cast<int>(p), points[p], kHeldPointM * kHeldPointM * Eigen::Matrix3d::Identity()});
  }
  return problem;
}

// How well each coordinate is known before: 0 by definition of the frame, or flat.
Eigen::Vector3d prior_sigma(const FramedCase& framed, int point) {
  const double held = framed.priors.held_m, flat = framed.priors.ground_flat_m;
  if (point == framed.roles.origin) return {held, held, held};
  if (point == framed.roles.x_axis) return {kUnknownM, held, held};
  return {kUnknownM, kUnknownM, point == framed.roles.plane ? held : flat};
}

KnownBy known_by(const FrameRoles& roles, int point) {
  if (point == roles.origin) return KnownBy::kFrameOrigin;
  if (point == roles.x_axis) return KnownBy::kFrameXAxis;
  return point == roles.plane ? KnownBy::kFramePlane : KnownBy::kFlatGround;
}

Problem final_problem(const FramedCase& framed, const std::vector<Eigen::Vector3d>& points) {
  Problem problem = bare_problem(framed);
  problem.lengths.push_back(framed.length);
  for (int p = 0; p < static_cast<int>(points.size()); ++p) {
    Eigen::Vector3d known(points[at(p)].x(), points[at(p)].y(), 0);
    if (p == framed.roles.x_axis) known.y() = 0;
    if (p == framed.roles.origin) known.setZero();
    const Eigen::Matrix3d covariance = prior_sigma(framed, p).cwiseAbs2().asDiagonal();
    problem.control.push_back({p, known, covariance, known_by(framed.roles, p)});
  }
  return problem;
}

Network whole_network(const Problem& problem) {
  std::vector<int> photos(problem.photos.size());
  std::iota(photos.begin(), photos.end(), 0);
  return make_network(problem, std::move(photos));
}

TermOptions terms_of(const FramedCase& framed) {
  TermOptions terms;
  terms.tilt_sigma_rad = framed.priors.tilt_deg * kRadPerDeg;
  return terms;
}

double rms_px(const Network& network, const State& state) {
  double squares = 0;
  for (const Ray& ray : network.rays) {
    if (const auto residual = residual_of(ray, state)) squares += residual->squaredNorm();
  }
  return std::sqrt(squares / std::max(static_cast<double>(network.rays.size()), 1.0));
}

Adjusted stage_of(const Network& network, const Minimum& minimum) {
  return {minimum.state.interior,         minimum.state.poses, minimum.state.points,
          rms_px(network, minimum.state), minimum.iterations,  minimum.converged};
}

State state_of(const geometry::InteriorVector& interior, const std::vector<geometry::Pose>& poses,
               const std::vector<Eigen::Vector3d>& points) {
  State state;
  state.interior = interior;
  state.poses = poses;
  state.points = points;
  return state;
}

// What the declared knowledge is called among the groups of the adjustment.
void name_priors(Summary& summary) {
  auto& groups = summary.sigma0_by_group;
  if (const auto control = groups.find("control"); control != groups.end()) {
    groups["flat_ground"] = control->second;
    groups.erase("control");
  }
}

}  // namespace

Adjusted resect(const FramedCase& framed, const RelativeOrientation& relative,
                const ScaledModel& model) {
  const Problem problem = resection_problem(framed, model.points);
  const Network network = whole_network(problem);
  const State start = state_of(relative.interior, model.poses, model.points);
  const MinimiseOptions how{0, kMaxIterations, kTolerance};
  Adjusted out = stage_of(network, minimise(network, start, start, terms_of(framed), how));
  out.points = model.points;
  return out;
}

Result<FinalAdjustment> adjust_all(const FramedCase& framed, const Adjusted& start,
                                   const Options& options) {
  const Problem problem = final_problem(framed, start.points);
  Network network = whole_network(problem);
  const TermOptions terms = terms_of(framed);
  const State datum = state_of(start.interior, start.poses, start.points);
  Minimum minimum;
  minimum.state = datum;
  int iterations = 0;
  for (int round = 0;; ++round) {
    minimum = minimise(network, minimum.state, datum, terms, {0, kMaxIterations, kTolerance});
    iterations += minimum.iterations;
    const RaysLinear rays = linearise_rays(network, minimum.state, 0);
    const auto linear = linearised_terms(network, minimum.state, datum, terms);
    const auto covariance =
        NetworkCovariance::of(network, normal_equations(network, minimum.state, 0, linear));
    if (!covariance) {
      return Error{
          "The final adjustment of the published procedure is singular even with its "
          "priors: too few points, or all of them in one place."};
    }
    const GroupFits fits = group_fits(network, *covariance, rays.rays, linear);
    if (rescale_by_variance(network, fits) > kSigmaSettled && round < kMaxRounds) continue;
    Solution solution = solution_of({network,
                                     minimum.state,
                                     terms,
                                     *covariance,
                                     *covariance,
                                     fits,
                                     linear,
                                     datum,
                                     {},
                                     iterations,
                                     minimum.converged},
                                    options);
    name_priors(solution.summary);
    auto framed_solution = in_three_point_frame(problem, solution, framed.roles, options);
    if (!framed_solution) return framed_solution.error();
    minimum.iterations = iterations;
    return FinalAdjustment{stage_of(network, minimum), *std::move(framed_solution)};
  }
}

}  // namespace plumbline::orient::paper
