// SPDX-License-Identifier: MIT
#include "edge/image/patch.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace plumbline::image {
namespace {

// Keys 1981, equation 15, at distances 1 + t, t, 1 - t, 2 - t.
std::array<float, 4> cubic_weights(float t) {
  const float t2 = t * t;
  const float t3 = t2 * t;
  return {-0.5F * t3 + t2 - 0.5F * t, 1.5F * t3 - 2.5F * t2 + 1.0F,
          -1.5F * t3 + 2.0F * t2 + 0.5F * t, 0.5F * t3 - 0.5F * t2};
}

std::array<float, 4> cubic_slopes(float t) {
  const float t2 = t * t;
  return {-1.5F * t2 + 2.0F * t - 0.5F, 4.5F * t2 - 5.0F * t, -4.5F * t2 + 4.0F * t + 0.5F,
          1.5F * t2 - t};
}

float dot(const std::array<float, 4>& weights, const float* values) {
  return weights[0] * values[0] + weights[1] * values[1] + weights[2] * values[2] +
         weights[3] * values[3];
}

float bilinear(const cv::Mat& image, float u, float v) {
  const int u0 = static_cast<int>(u);
  const int v0 = static_cast<int>(v);
  const float a = u - static_cast<float>(u0);
  const float b = v - static_cast<float>(v0);
  const std::uint8_t* top = image.ptr<std::uint8_t>(v0) + u0;
  const std::uint8_t* low = image.ptr<std::uint8_t>(v0 + 1) + u0;
  return (1 - b) * ((1 - a) * top[0] + a * top[1]) + b * ((1 - a) * low[0] + a * low[1]);
}

bool square_inside(const cv::Mat& image, const Eigen::Vector2d& centre,
                   const Eigen::Matrix2d& steps, int half) {
  const Eigen::Vector2d reach = half * steps.cwiseAbs().rowwise().sum();
  return centre.x() - reach.x() >= 0 && centre.y() - reach.y() >= 0 &&
         centre.x() + reach.x() < image.cols - 1.01 && centre.y() + reach.y() < image.rows - 1.01;
}

int level_for(const PhotoLevels& photo, double step_px) {
  const int wanted = static_cast<int>(std::lround(std::log2(std::max(step_px, 1.0))));
  return std::min(wanted, static_cast<int>(photo.level.size()) - 1);
}

}  // namespace

Eigen::Vector2d PhotoLevels::size_px() const {
  return empty() ? Eigen::Vector2d(0, 0) : Eigen::Vector2d(full().cols, full().rows);
}

PhotoLevels make_levels(const Image& photo, int levels) {
  PhotoLevels result;
  const cv::Mat view(photo.height_px, photo.width_px, CV_8UC1,
                     const_cast<std::uint8_t*>(photo.data.data()));
  result.level.push_back(view.clone());
  for (int l = 1; l < levels; ++l) {
    const cv::Mat& above = result.level.back();
    if (std::min(above.cols, above.rows) < 32) break;
    cv::Mat below;
    cv::pyrDown(above, below);
    result.level.push_back(below);
  }
  return result;
}

Window smoothed_window(const cv::Mat& photo, const Eigen::Vector2d& centre_px, double radius_px,
                       double sigma_px) {
  Window window;
  const bool near = centre_px.x() > -radius_px && centre_px.x() < photo.cols + radius_px &&
                    centre_px.y() > -radius_px && centre_px.y() < photo.rows + radius_px;
  if (!near) return window;
  const cv::Point low(static_cast<int>(std::floor(centre_px.x() - radius_px)),
                      static_cast<int>(std::floor(centre_px.y() - radius_px)));
  const int side = 2 * static_cast<int>(std::ceil(radius_px)) + 2;
  const cv::Rect piece = cv::Rect(low, cv::Size(side, side)) & cv::Rect({0, 0}, photo.size());
  if (piece.width < 8 || piece.height < 8) return window;
  photo(piece).convertTo(window.values, CV_32F);
  if (sigma_px > 0.05) {
    cv::GaussianBlur(window.values, window.values, {0, 0}, sigma_px, sigma_px,
                     cv::BORDER_REFLECT_101 | cv::BORDER_ISOLATED);
  }
  window.origin = Eigen::Vector2d(piece.x, piece.y);
  return window;
}

std::optional<GreySample> sample_cubic(const Window& window, const Eigen::Vector2d& pixel) {
  const Eigen::Vector2d local = pixel - window.origin;
  if (!(local.x() >= 2 && local.y() >= 2 && local.x() < window.values.cols - 3 &&
        local.y() < window.values.rows - 3)) {
    return std::nullopt;
  }
  const int u = static_cast<int>(local.x());
  const int v = static_cast<int>(local.y());
  const auto wu = cubic_weights(static_cast<float>(local.x() - u));
  const auto su = cubic_slopes(static_cast<float>(local.x() - u));
  std::array<float, 4> across{};
  std::array<float, 4> slope{};
  for (int row = 0; row < 4; ++row) {
    const float* values = window.values.ptr<float>(v - 1 + row) + u - 1;
    across[static_cast<std::size_t>(row)] = dot(wu, values);
    slope[static_cast<std::size_t>(row)] = dot(su, values);
  }
  const auto wv = cubic_weights(static_cast<float>(local.y() - v));
  const auto sv = cubic_slopes(static_cast<float>(local.y() - v));
  return GreySample{dot(wv, across.data()), dot(wv, slope.data()), dot(sv, across.data())};
}

double scale_of(const Eigen::Matrix2d& jacobian) {
  return std::sqrt(std::abs(jacobian.determinant()));
}

cv::Mat sample_square(const PhotoLevels& photo, const Eigen::Vector2d& centre_px,
                      const Eigen::Matrix2d& steps, int half) {
  const int level = level_for(photo, scale_of(steps));
  const cv::Mat& image = photo.level[static_cast<std::size_t>(level)];
  const double shrink = 1.0 / (1 << level);
  const Eigen::Vector2d centre = centre_px * shrink;
  const Eigen::Matrix2d step = steps * shrink;
  if (!square_inside(image, centre, step, half)) return {};
  cv::Mat square(2 * half + 1, 2 * half + 1, CV_32F);
  for (int row = -half; row <= half; ++row) {
    float* out = square.ptr<float>(row + half);
    for (int col = -half; col <= half; ++col) {
      const Eigen::Vector2d at = centre + step * Eigen::Vector2d(col, row);
      out[col + half] = bilinear(image, static_cast<float>(at.x()), static_cast<float>(at.y()));
    }
  }
  return square;
}

}  // namespace plumbline::image
