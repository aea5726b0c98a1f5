// SPDX-License-Identifier: MIT
#include "edge/orient/adjust.h"

#include <algorithm>
#include <cmath>

#include "edge/base/median.h"
#include "edge/base/units.h"
#include "edge/orient/findings/no_solution.h"
#include "edge/orient/findings/solution_of.h"
#include "edge/orient/network/minimise.h"
#include "edge/orient/network/rays.h"
#include "edge/orient/network/stations.h"
#include "edge/orient/network/step.h"
#include "edge/orient/precision/bent_covariance.h"
#include "edge/orient/reliability/doubts.h"
#include "edge/orient/reliability/group_fits.h"
#include "edge/orient/reliability/image_correlation.h"
#include "edge/orient/start/align.h"
#include "edge/orient/start/azimuth_search.h"
#include "edge/orient/start/free_start.h"
#include "edge/orient/validate.h"

namespace plumbline::orient {
namespace {

// Cauchy scales in sigmas, annealed from crude to sharp.
constexpr double kCrude[] = {100, 20, 6};
constexpr double kSharp[] = {6, 2.5};
// The free network is a long, curved valley (focal length, height and tilt all but compensate):
// the crude stages need only come near enough for the stations to take over.
constexpr int kCrudeIterations = 30;
constexpr double kCrudeTolerance = 1e-4;
constexpr double kRobustTolerance = 1e-6;
constexpr double kFinalTolerance = 1e-13;
// Along the valley of a climb that knows no azimuth the last metres are slow.
constexpr int kFinalPatience = 5;  // times the iterations of a stage
// Photos whose largest separation is below this share of the flying height stand on one place: of
// less, image noise alone makes as much.
constexpr double kLeastBase = 0.02;
// A point whose own sigma is beyond this share of the flying height (at the foot of a climb) is no
// measurement; where it comes to lie by chance, its linearisation would pull at the rest.
constexpr double kFarPoint = 0.1;
// Nor is one whose height all in all is known so badly, where the median is better by this factor.
constexpr double kOutlyingSigma = 10;
// Heights worse than this share of the flying height (median sigma) are none.
constexpr double kWorstHeight = 0.5;
// A camera that the photos ask for, against all that is known of it, is asked for by image errors
// that no camera model explains: ties lose weight until both agree.
constexpr int kMaxWidenings = 12;
// The 0.1 % point of chi-square with r degrees of freedom is r + 3.1 sqrt(2 r) + 5.5 to 2 % for r
// up to 10.
constexpr double kSignificantSigmas = 3.1;
constexpr double kSmallSampleMargin = 5.5;
constexpr int kMaxRounds = 12;
constexpr double kSigmaSettled = 0.002;

class Adjustment {
 public:
  Adjustment(const Problem& problem, const Options& options, FreeStart start)
      : problem_(problem),
        options_(options),
        network_(make_network(problem, std::move(start.photo_of_slot))),
        state_(std::move(start.state)) {
    terms_.tilt_sigma_rad = options.tilt_sigma_deg * kRadPerDeg;
  }

  Result<Solution> run() {
    orient_freely();
    if (!has_base()) return no_base();
    orient_onto_known();
    auto solution = finish();
    if (!solution) return solution;
    const Summary& summary = solution->summary;
    if (!(summary.flying_height_m > 0) || !(summary.common.height < kWorstHeight)) return no_base();
    return solution;
  }

 private:
  void minimise_from(const State& datum, const MinimiseOptions& how) {
    if (how.cauchy_scale > 0) replant_wild_points(network_, state_);
    const Minimum minimum = minimise(network_, state_, datum, terms_, how);
    state_ = minimum.state;
    iterations_ += minimum.iterations;
    converged_ = minimum.converged;
  }

  void orient_freely() {
    terms_.datum = Datum::kFree;
    terms_.bridle_interior = true;
    // Velocities are in metres of the ground, which the photos alone do not know.
    network_.shared_mask[kLineTime] = network_.shared_mask[kDelay] = 0;
    const State start = state_;
    drop_unprojectable(network_, state_);
    for (const double scale : kCrude) {
      minimise_from(start, {scale, kCrudeIterations, kCrudeTolerance});
      rescale_by_median(network_, state_);
    }
  }

  static Error no_base() {
    return {
        "All photos were taken from (nearly) the same place, so no height can be measured; "
        "photos from different heights, or a side-step, are needed."};
  }

  bool has_base() const {
    const double height = flying_height(network_, state_);
    double base = 0;
    for (const auto& a : state_.poses) {
      for (const auto& b : state_.poses) base = std::max(base, (a.centre_m - b.centre_m).norm());
    }
    return base > kLeastBase * std::abs(height);
  }

  void orient_onto_known() {
    terms_.datum = Datum::kKnown;
    terms_.bridle_interior = false;
    terms_.station_weights.assign(at(network_.slots()), 1.0);
    network_.shared_mask = shared_mask_of(problem_);
    state_.line_time_s = problem_.camera.line_time_us * kSecondsPerMicrosecond;
    state_.delay_s = problem_.delay.seconds;
    soften_claims(network_, aligned(network_, state_, terms_), terms_);
    descend_from_best_azimuth();
    for (const double scale : kSharp) {
      minimise_from(datum_, {scale, options_.max_iterations, kRobustTolerance});
      rescale_by_median(network_, state_);
      if (station_slots(network_, terms_).size() >= kLeastStations) {
        terms_.station_weights = robust_station_weights(network_, state_);
      }
      reweigh_claims(network_, state_, terms_);
    }
    minimise_from(datum_, {kSharp[1], options_.max_iterations, kRobustTolerance});
    terms_.station_weights.clear();
    terms_.length_weights.clear();
    terms_.control_weights.clear();
  }

  void descend_from_best_azimuth() {
    Descent descent = descend_around_circle(network_, state_, terms_,
                                            {kSharp[0], options_.max_iterations, kRobustTolerance});
    datum_ = std::move(descent.start);
    state_ = std::move(descent.end.state);
    iterations_ += descent.end.iterations;
  }

  // Plain least squares without what was found to be wrong, so that the covariance is honest.
  Result<Solution> finish() {
    datum_ = state_;  // a prior on what nobody knows pulls at nothing
    reject_gross_claims();
    double tolerance = kRobustTolerance;
    bool doubted = false;
    for (int round = 0;; ++round) {
      // While a wrong claim pulls, rays are not judged.
      int changed = doubted ? 0 : reject_rays(network_, state_, options_.rejection_sigma);
      changed += drop_far_points() + drop_points_at_cameras(network_, state_);
      const int patience = tolerance == kFinalTolerance ? kFinalPatience : 1;
      minimise_from(datum_, {0, patience * options_.max_iterations, tolerance});
      // One that was led to a camera has dragged the rest along.
      if (drop_points_at_cameras(network_, state_) > 0) {
        --round;
        continue;
      }
      const RaysLinear rays = linearise_rays(network_, state_, 0);
      const auto terms = linearised_terms(network_, state_, datum_, terms_);
      const auto equations = normal_equations(network_, state_, 0, terms);
      const auto covariance = NetworkCovariance::of(network_, equations);
      if (!covariance) return no_solution(network_, state_);
      doubted = doubts_.revise(network_, state_, datum_, *covariance, terms, terms_);
      if (doubted) {
        --round;
        continue;
      }
      const GroupFits fits = group_fits(network_, *covariance, rays.rays, terms);
      const double sigma_change = rescale_by_variance(network_, fits);
      const bool last = round + 1 >= kMaxRounds;
      const bool settled = changed == 0 && sigma_change < kSigmaSettled;
      if (!settled && !last) continue;
      if (widen(fits)) continue;
      if (tolerance == kFinalTolerance) {
        const NetworkCovariance bars =
            options_.bent_error_bars
                ? bent_covariance(network_, state_, datum_, terms_, *covariance)
                : *covariance;
        if (drop_points_without_height(bars) > 0) continue;
        if (agreement(network_).is_chance()) return contradiction(network_);
        return solution_of({network_, state_, terms_, *covariance, bars, fits, terms, datum_,
                            doubts_.rejected(), iterations_, converged_},
                           options_);
      }
      tolerance = kFinalTolerance;
    }
  }

  // A control point 20 m off would tear a plain adjustment to pieces. Where the robust one has
  // come to, a step of the plain one tells as much, without taking it.
  void reject_gross_claims() {
    reject_rays(network_, state_, options_.rejection_sigma);
    drop_far_points();
    drop_points_at_cameras(network_, state_);
    for (bool found = true; found;) {
      auto terms = linearised_terms(network_, state_, datum_, terms_);
      const auto equations = normal_equations(network_, state_, 0, terms);
      const auto covariance = NetworkCovariance::of(network_, equations);
      const auto step = solve(equations, 0);
      if (!covariance || !step) return;
      for (Term& term : terms) term.residual += term.jacobian * step->common(term.columns);
      found = doubts_.reject_worst(network_, *covariance, terms, terms_);
    }
  }

  // At the end: true where the error bars of the ties had to be widened (once more).
  bool widen(const GroupFits& fits) {
    double effect = 1;
    if (widenings_ == 0) {
      effect = image_correlation(network_, state_).design_effect;
    } else if (const auto camera = fits.find("camera"); camera != fits.end()) {
      const GroupFit& fit = camera->second;
      const double r = std::max(fit.redundancy, 0.0);
      if (r > 0 && fit.squares > r + kSignificantSigmas * std::sqrt(2 * r) + kSmallSampleMargin)
        effect = std::sqrt(fit.squares / fit.redundancy);
    }
    const bool again = widenings_ == 0 || effect > 1;
    if (!has_ties() || !again || widenings_++ == kMaxWidenings) return false;
    network_.ties_design_effect *= effect;
    return true;
  }

  bool has_ties() const {
    return std::any_of(network_.rays.begin(), network_.rays.end(),
                       [](const Ray& ray) { return ray.group == ImageGroup::kTies; });
  }

  int drop_far_points() {
    const double limit = kFarPoint * std::abs(flying_height(network_, state_));
    return drop_undetermined(network_, normal_equations(network_, state_, 0, {}), limit);
  }

  // On the axis of a straight climb a height may be anything, and where such a point comes to lie
  // its rays may seem to meet well: only all that is known together tells. Returns how many went.
  int drop_points_without_height(const NetworkCovariance& bars) {
    const auto covariances_m2 = bars.point_covariances();
    std::vector<double> sigmas_m;
    for (int p = 0; p < network_.points(); ++p) {
      if (bars.point(p).measured) sigmas_m.push_back(std::sqrt(covariances_m2[at(p)](2, 2)));
    }
    if (sigmas_m.empty()) return 0;
    const double limit_m = std::max(kFarPoint * std::abs(flying_height(network_, state_)),
                                    kOutlyingSigma * upper_median(std::move(sigmas_m)));
    int dropped = 0;
    for (int p = 0; p < network_.points(); ++p) {
      const bool held = network_.layout.kept_of_point[at(p)] >= 0;
      if (!bars.point(p).measured || held || !(covariances_m2[at(p)](2, 2) > limit_m * limit_m))
        continue;
      drop_for_good(network_, p);
      ++dropped;
    }
    return dropped;
  }

  const Problem& problem_;
  const Options& options_;
  Network network_;
  State state_;
  State datum_;
  TermOptions terms_;
  Doubts doubts_;
  int iterations_ = 0;
  bool converged_ = false;
  int widenings_ = 0;
};

}  // namespace

Result<Solution> adjust(const Problem& problem, const Options& options) {
  if (auto status = validate(problem); !status) return status.error();
  auto start = free_start(problem);
  if (!start) return start.error();
  return Adjustment(problem, options, std::move(*start)).run();
}

}  // namespace plumbline::orient
