// SPDX-License-Identifier: MIT
#include "edge/plan/prediction.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "edge/base/index.h"
#include "edge/base/units.h"
#include "edge/geometry/standard_accuracy.h"
#include "edge/orient/findings/diagnosis.h"
#include "edge/orient/network/normal_equations.h"
#include "edge/orient/network/rays.h"
#include "edge/orient/network/terms.h"
#include "edge/orient/precision/covariance.h"
#include "edge/orient/precision/local_frame_fit.h"
#include "edge/plan/model.h"
#include "edge/plan/ring_frame.h"

namespace plumbline::plan {
namespace {

// As the adjustment has it: a point whose own sigma is beyond this share of the flying height is
// not given.
constexpr double kFarPoint = 0.1;
// The adjustment takes an azimuth that nobody knows as uniform over the circle.
constexpr double kUniformAzimuthRad = std::numbers::pi / std::numbers::sqrt3;

// Mean of variances by axis; empty where too few of the points have one.
class Mean {
 public:
  void add(const Eigen::Matrix3d& covariance, double weight) {
    plan_ += 0.5 * weight * (covariance(0, 0) + covariance(1, 1));
    height_ += weight * covariance(2, 2);
    weight_ += weight;
  }
  void miss(double weight) { missed_ += weight; }
  double share() const { return weight_ + missed_ > 0 ? weight_ / (weight_ + missed_) : 0; }
  Sigma sigma() const {
    constexpr double kLeastShare = 0.5;
    if (share() < kLeastShare) return {};
    return {std::sqrt(plan_ / weight_), std::sqrt(height_ / weight_)};
  }

 private:
  double plan_ = 0, height_ = 0, weight_ = 0, missed_ = 0;
};

struct BothMeans {
  Mean local, absolute;
};

// "Near the vertical" says nothing of an azimuth: turned about the vertical, tilts keep their
// squared sum. Gauss and Newton's matrix takes the change of each for information and leaves out
// the second derivatives that cancel it; so the derivative by that turn is left out instead.
void free_azimuth_of_tilts(std::vector<orient::Term>& terms) {
  for (orient::Term& term : terms) {
    if (term.group == "attitude") term.jacobian.rightCols<1>().setZero();
  }
}

// The adjustment of a model, at its end.
struct Adjusted {
  orient::Network network;
  orient::TermOptions terms;
  std::optional<orient::NetworkCovariance> covariance;
};

// A point that stands for n ties weighs as n: Schur complements add up.
void weigh_ties(const Model& model, const Options& options, orient::Network& network) {
  for (orient::Ray& ray : network.rays) {
    ray.sigma_px = options.sigma_px / std::sqrt(model.points[at(ray.point)].ties);
  }
}

Adjusted adjusted(const Model& model, const Options& options) {
  std::vector<int> photos(model.problem.photos.size());
  std::iota(photos.begin(), photos.end(), 0);
  Adjusted out{orient::make_network(model.problem, std::move(photos)), {}, {}};
  const auto equations = [&](const std::vector<orient::Term>& terms) {
    return normal_equations(out.network, model.truth, 0, terms);
  };
  const double limit = kFarPoint * orient::flying_height(out.network, model.truth);
  drop_undetermined(out.network, equations({}), limit);
  weigh_ties(model, options, out.network);
  out.terms.tilt_sigma_rad = options.adjustment.tilt_sigma_deg * kRadPerDeg;
  auto terms = linearised_terms(out.network, model.truth, model.truth, out.terms);
  free_azimuth_of_tilts(terms);
  out.covariance = orient::NetworkCovariance::of(out.network, equations(terms));
  return out;
}

class Reader {
 public:
  Reader(const Model& model, const Options& options, const Adjusted& adjusted)
      : model_(model),
        options_(options),
        adjusted_(adjusted),
        ring_frame_(model.truth, covariance(), points(true)),
        absolute_(covariance().point_covariances()) {
    frame_ = fit_local_frame(model.truth, covariance(), absolute_, points(false));
    undo_weights();
  }

  Prediction read() const {
    Prediction out;
    out.photos = static_cast<int>(model_.truth.poses.size());
    out.georeferenced = model_.georeferenced;
    read_common(out);
    read_rings(out);
    return out;
  }

 private:
  const orient::NetworkCovariance& covariance() const { return *adjusted_.covariance; }

  // A point that stands for n ties has the own part of their mean: one of them has n times that.
  void undo_weights() {
    for (int p = 0; p < covariance().points(); ++p) {
      const Eigen::Matrix3d more = (model_.points[at(p)].ties - 1) * covariance().point(p).own;
      absolute_[at(p)] += more;
      frame_.local_covariance_m2[at(p)] += more;
    }
  }

  // Those that are there to be looked at, or those that stand for ties.
  std::vector<int> points(bool in_rings) const {
    std::vector<int> out;
    for (std::size_t p = 1; p < model_.points.size(); ++p) {
      if ((model_.points[p].ring >= 0) == in_rings) out.push_back(static_cast<int>(p));
    }
    return out;
  }

  void read_common(Prediction& out) const {
    const orient::Evidence evidence{adjusted_.network, model_.truth, adjusted_.terms, covariance(),
                                    frame_};
    out.flying_height_m = orient::flying_height(adjusted_.network, model_.truth);
    const orient::CommonSigmas sigmas = common_sigmas(evidence, out.flying_height_m);
    out.unobservable = unobservable(evidence, sigmas, options_.adjustment);
    const double share = 1 - options_.adjustment.min_variance_reduction;
    if (sigmas.azimuth_rad < std::sqrt(share) * kUniformAzimuthRad) {
      out.azimuth_deg = sigmas.azimuth_rad * kDegPerRad;
    }
    if (std::isfinite(sigmas.tilt_rad)) out.tilt_deg = sigmas.tilt_rad * kDegPerRad;
    if (std::isfinite(sigmas.scale)) out.scale = sigmas.scale;
    if (std::isfinite(sigmas.position_m)) out.position_m = sigmas.position_m;
    out.focal_length_px = sigmas.focal_length * model_.truth.interior[geometry::kFocalLength];
    say_more(out);
  }

  // What a plan knows better than an adjustment: that the line is straight, and where its foot is.
  void say_more(Prediction& out) const {
    for (orient::Unobservable& item : out.unobservable) {
      if (item.name != "azimuth" || out.azimuth_deg || !out.georeferenced) continue;
      item.sentence =
          "The azimuth cannot be seen: all photos are taken on one line, about which their "
          "positions fix no turn. A side-step of 5 to 10 m, a heading, or a control point away "
          "from the foot fixes it. Without, the ground is measured in shape, height and scale, "
          "but not which way it lies.";
    }
    if (!covariance().point(0).measured) {
      out.unobservable.push_back({"height_at_foot",
                                  "The height of the very foot of the climb has no parallax from "
                                  "above, and near it heights are poor. A side-step sees it."});
    }
  }

  void add(int point, double weight, BothMeans& means) const {
    const orient::PointFactor& factor = covariance().point(point);
    if (!factor.measured) {
      means.local.miss(weight);
      means.absolute.miss(weight);
      return;
    }
    means.absolute.add(absolute_[at(point)], weight);
    const GroundPoint& ground = model_.points[at(point)];
    const bool looked_at = ground.ring >= 0 || point == 0;
    means.local.add(looked_at ? ring_frame_.local_covariance_m2(point, ground.ties * factor.own)
                              : frame_.local_covariance_m2[at(point)],
                    weight);
  }

  GroundSigma sigma_of(const BothMeans& means, const Prediction& out) const {
    GroundSigma sigma{means.local.sigma(), {}};
    if (out.georeferenced) sigma.absolute = means.absolute.sigma();
    if (!out.azimuth_deg) sigma.absolute.plan_m.reset();
    return sigma;
  }

  void read_rings(Prediction& out) const {
    std::vector<BothMeans> rings(model_.rings.size());
    BothMeans field, foot;
    for (std::size_t p = 0; p < model_.points.size(); ++p) {
      const GroundPoint& point = model_.points[p];
      const int index = static_cast<int>(p);
      if (point.ring >= 0) add(index, 1, rings[at(point.ring)]);
      if (p == 0) add(index, 1, foot);
      if (p > 0 && point.ring < 0) add(index, point.ties, field);
    }
    out.field = sigma_of(field, out);
    out.foot = sigma_of(foot, out);
    for (std::size_t k = 0; k < rings.size(); ++k) {
      out.rings.push_back({model_.rings[k], sigma_of(rings[k], out), rings[k].local.share(),
                           formula_height(model_.rings[k])});
    }
  }

  // At the middle of the ring; the photos on the line alone.
  std::optional<double> formula_height(const Ring& ring) const {
    constexpr double kOnLineM = 1;
    std::vector<double> heights;
    const Eigen::Vector2d foot = model_.points[0].in_enu_m.head<2>();
    for (const auto& pose : model_.truth.poses) {
      if ((pose.centre_m.head<2>() - foot).norm() < kOnLineM) heights.push_back(pose.centre_m.z());
    }
    const double sigma = geometry::climb_height_accuracy_m(
        heights, 0.5 * (ring.from_m + ring.to_m), options_.camera.interior[0], options_.sigma_px);
    return std::isfinite(sigma) ? std::optional(sigma) : std::nullopt;
  }

  const Model& model_;
  const Options& options_;
  const Adjusted& adjusted_;
  RingFrame ring_frame_;
  std::vector<Eigen::Matrix3d> absolute_;
  orient::LocalFrameFit frame_;  // of all points that stand for ties
};

void keep_worse(const std::optional<double>& value, std::optional<double>& worst) {
  if (!value || !worst) {
    worst.reset();
  } else {
    worst = std::max(*worst, *value);
  }
}

}  // namespace

Result<Prediction> predict(const Flight& flight, const Options& options, Detail detail) {
  if (auto status = check(flight, options); !status) return status.error();
  const Model model = model_of(flight, options, detail);
  const Adjusted end = adjusted(model, options);
  if (!end.covariance) {
    return Error{
        "The flight determines nothing: too little ground is seen in two photos, or they stand too "
        "close together for their height and image sigma. Climb further, or step aside."};
  }
  return Reader(model, options, end).read();
}

Sigma worst_ring(const Prediction& prediction) {
  Sigma worst{0, 0};
  for (const RingSigma& ring : prediction.rings) {
    const Sigma& sigma = prediction.georeferenced ? ring.sigma.absolute : ring.sigma.local;
    keep_worse(sigma.plan_m, worst.plan_m);
    keep_worse(sigma.height_m, worst.height_m);
  }
  return worst;
}

}  // namespace plumbline::plan
