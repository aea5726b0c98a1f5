// SPDX-License-Identifier: MIT
#include "edge/image/least_squares_matching.h"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <vector>

namespace plumbline::image {
namespace {

using Vector8d = Eigen::Matrix<double, 8, 1>;
using Matrix8d = Eigen::Matrix<double, 8, 8>;

// Resolution of a sharp photo: sigma of its point spread, in its own pixels.
constexpr double kSharpness_px = 0.6;
// Both patches are smoothed by this as well, in pixels of the coarser photo: it halves what
// interpolation between noisy pixels adds to the position.
constexpr double kCommonSmoothing_px = 0.5;
constexpr int kMostIterations = 20;
// No match is better than this, whatever its texture: relief, light and lens inside the patch.
constexpr double kFloor_px = 0.02;

// Smoothing, in pixels of a photo, that brings it to a resolution `coarser` times lower.
double smoothing_for(double coarser) {
  const double added = kSharpness_px * kSharpness_px * std::max(coarser * coarser - 1.0, 0.0);
  const double common = kCommonSmoothing_px * std::max(coarser, 1.0);
  return std::sqrt(added + common * common);
}

struct Template {
  std::vector<Eigen::Vector2d> offset_px;  // from the reference point, in the reference photo
  std::vector<double> value;
  double spacing_px = 1;  // of neighbours, in the reference photo
};

std::optional<Template> cut_template(const cv::Mat& reference, const Eigen::Vector2d& centre_px,
                                     double spacing_px, int half) {
  const Window window = smoothed_window(
      reference, centre_px, spacing_px * half + 8 + spacing_px * 2, smoothing_for(spacing_px));
  if (window.values.empty()) return std::nullopt;
  Template patch;
  patch.spacing_px = spacing_px;
  for (int row = -half; row <= half; ++row) {
    for (int col = -half; col <= half; ++col) {
      const Eigen::Vector2d offset = spacing_px * Eigen::Vector2d(col, row);
      const auto sample = sample_cubic(window, centre_px + offset);
      if (!sample) return std::nullopt;
      patch.offset_px.push_back(offset);
      patch.value.push_back(sample->value);
    }
  }
  return patch;
}

// The unknowns: brightness offset and gain of the target, and the map.
struct State {
  LocalMap map;
  double offset = 0;
  double gain = 1;
};

struct Normals {
  Matrix8d matrix = Matrix8d::Zero();
  Vector8d right = Vector8d::Zero();
  double squares = 0;
};

// Residual: template - (offset + gain * target(map(x))), Gruen 1985 equations 6 to 9. Offsets
// inside the patch are scaled by `reach` to keep the normal matrix well conditioned.
std::optional<Normals> accumulate(const Template& patch, const Window& target, const State& state,
                                  double reach) {
  Normals normals;
  for (std::size_t i = 0; i < patch.value.size(); ++i) {
    const Eigen::Vector2d& x = patch.offset_px[i];
    const auto sample = sample_cubic(target, state.map.target_px + state.map.jacobian * x);
    if (!sample) return std::nullopt;
    const double gu = state.gain * sample->du;
    const double gv = state.gain * sample->dv;
    Vector8d row;
    row << gu, gv, gu * x.x() / reach, gu * x.y() / reach, gv * x.x() / reach, gv * x.y() / reach,
        1.0, sample->value;
    const double residual = patch.value[i] - state.offset - state.gain * sample->value;
    normals.matrix.selfadjointView<Eigen::Lower>().rankUpdate(row);
    normals.right += row * residual;
    normals.squares += residual * residual;
  }
  normals.matrix = normals.matrix.selfadjointView<Eigen::Lower>();
  return normals;
}

bool fit_brightness(const Template& patch, const Window& target, State& state) {
  double n = 0, st = 0, sg = 0, sgg = 0, sgt = 0;
  for (std::size_t i = 0; i < patch.value.size(); ++i) {
    const auto sample =
        sample_cubic(target, state.map.target_px + state.map.jacobian * patch.offset_px[i]);
    if (!sample) return false;
    const double g = sample->value;
    n += 1, st += patch.value[i], sg += g, sgg += g * g, sgt += g * patch.value[i];
  }
  const double spread = sgg - sg * sg / n;
  if (spread < n) return false;
  state.gain = (sgt - sg * st / n) / spread;
  state.offset = (st - state.gain * sg) / n;
  return state.gain > 0.05;
}

void apply(const Vector8d& step, double reach, State& state) {
  state.map.target_px += step.head<2>();
  state.map.jacobian(0, 0) += step(2) / reach;
  state.map.jacobian(0, 1) += step(3) / reach;
  state.map.jacobian(1, 0) += step(4) / reach;
  state.map.jacobian(1, 1) += step(5) / reach;
  state.offset += step(6);
  state.gain += step(7);
}

// A patch that had to be stretched or turned this far from the guess has slid onto other texture.
bool sane(const State& state, const LocalMap& guess, double most_shift_px) {
  const Eigen::Matrix2d change = state.map.jacobian * guess.jacobian.inverse();
  return change.allFinite() && state.gain > 0.05 && state.gain < 20 &&
         (state.map.target_px - guess.target_px).norm() < most_shift_px &&
         (change - Eigen::Matrix2d::Identity()).cwiseAbs().maxCoeff() < 0.5 &&
         change.determinant() > 0.5 && change.determinant() < 2.0;
}

double correlation_of(const Template& patch, double squares) {
  double sum = 0, sum2 = 0;
  for (const double value : patch.value) sum += value, sum2 += value * value;
  const double spread = sum2 - sum * sum / static_cast<double>(patch.value.size());
  return spread > 0 ? std::sqrt(std::max(0.0, 1.0 - squares / spread)) : 0.0;
}

// `scale` is target pixels per reference pixel. A photo smoothed over k^2 of its pixels has k^2
// times less noise, and so the smaller share of the match's error.
void share_error(const Eigen::Matrix2d& covariance_px2, double scale, PatchMatch& match) {
  const double noise_reference = std::min(1.0, scale * scale);
  const double noise_target = std::min(1.0, 1.0 / (scale * scale));
  const double share = noise_target / (noise_target + noise_reference);
  const Eigen::Matrix2d floor = kFloor_px * kFloor_px * Eigen::Matrix2d::Identity();
  const Eigen::Matrix2d back = match.map.jacobian.inverse();
  match.target_covariance_px2 = share * covariance_px2 + floor;
  match.reference_covariance_px2 = (1 - share) * back * covariance_px2 * back.transpose() + floor;
}

}  // namespace

std::optional<PatchMatch> match_patch(const cv::Mat& reference, const cv::Mat& target,
                                      const LocalMap& guess, const MatchOptions& options) {
  const double scale = scale_of(guess.jacobian);
  if (!(scale > 0.1 && scale < 10)) return std::nullopt;
  const double unit_px = std::max(1.0, scale);  // a pixel of the coarser photo, in the target
  const auto patch =
      cut_template(reference, guess.reference_px, std::max(1.0, 1.0 / scale), options.half_size);
  if (!patch) return std::nullopt;
  const double reach = patch->spacing_px * options.half_size;
  const Window window = smoothed_window(
      target, guess.target_px, unit_px * (options.half_size * 1.6 + options.most_shift) + 4,
      smoothing_for(scale));
  State state{guess, 0, 1};
  if (window.values.empty() || !fit_brightness(*patch, window, state)) return std::nullopt;
  for (int iteration = 0; iteration < kMostIterations; ++iteration) {
    const auto normals = accumulate(*patch, window, state, reach);
    if (!normals) return std::nullopt;
    const Eigen::LDLT<Matrix8d> factors(normals->matrix);
    const Vector8d step = factors.solve(normals->right);
    if (!step.allFinite()) return std::nullopt;
    apply(step, reach, state);
    if (!sane(state, guess, options.most_shift * unit_px)) return std::nullopt;
    if (step.head<6>().cwiseAbs().maxCoeff() > 0.01 * unit_px) continue;
    const double freedom = static_cast<double>(patch->value.size()) - 8.0;
    const Matrix8d inverse = factors.solve(Matrix8d::Identity());
    const Eigen::Matrix2d covariance = normals->squares / freedom * inverse.topLeftCorner<2, 2>();
    PatchMatch match{state.map, {}, {}, correlation_of(*patch, normals->squares)};
    const double sigma_px = std::sqrt(covariance.diagonal().maxCoeff());
    if (match.correlation < options.least_correlation || !(sigma_px < options.most_sigma * unit_px))
      return std::nullopt;
    share_error(covariance, scale, match);
    return match;
  }
  return std::nullopt;
}

}  // namespace plumbline::image
