// SPDX-License-Identifier: MIT
#include "edge/image/least_squares_matching.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "synthetic.h"

namespace plumbline::image {
namespace {

using synthetic::Sensor;
using synthetic::Texture;

constexpr int kSide_px = 260;
constexpr double kGroundPixel_m = 0.05;

// Two views of flat ground: the first upright, the second turned and `scale` times finer.
struct Pair {
  cv::Mat first;
  cv::Mat second;
  Eigen::Matrix2d jacobian;  // second from first
  Eigen::Vector2d shift;

  Eigen::Vector2d second_of(const Eigen::Vector2d& first_px) const {
    return jacobian * first_px + shift;
  }
};

cv::Mat mat_of(const Image& image) {
  return cv::Mat(image.height_px, image.width_px, CV_8UC1,
                 const_cast<std::uint8_t*>(image.data.data()))
      .clone();
}

Pair make_pair(double scale, double turn_deg, double noise_grey, int jpeg_quality,
               std::uint64_t seed) {
  const Texture texture(seed, 40 * kGroundPixel_m, 0.2 * kGroundPixel_m);
  Pair pair;
  pair.jacobian = scale * Eigen::Rotation2Dd(turn_deg * M_PI / 180).toRotationMatrix();
  pair.jacobian(0, 1) += 0.03 * scale;
  const Eigen::Vector2d middle(kSide_px / 2.0, kSide_px / 2.0);
  pair.shift = middle + Eigen::Vector2d(0.37, -0.21) - pair.jacobian * middle;
  const Eigen::Matrix2d back = pair.jacobian.inverse();
  Sensor sensor{kSide_px, kSide_px, 0.5, noise_grey, seed, 3};
  const auto ground = [&](const Eigen::Vector2d& first_px) {
    return texture.grey(kGroundPixel_m * first_px.x(), kGroundPixel_m * first_px.y());
  };
  const Image first = synthetic::expose(ground, sensor);
  sensor.seed = seed + 1000;
  const Image second = synthetic::expose(
      [&](const Eigen::Vector2d& pixel) { return ground(back * (pixel - pair.shift)); }, sensor);
  const auto finish = [&](const Image& image) {
    return mat_of(jpeg_quality > 0 ? synthetic::through_jpeg(image, jpeg_quality) : image);
  };
  pair.first = finish(first);
  pair.second = finish(second);
  return pair;
}

struct Score {
  int tried = 0;
  int matched = 0;
  Eigen::Vector2d bias_px = Eigen::Vector2d::Zero();  // in pixels of the coarser photo
  double rms_px = 0;                                  // per axis
  double normalised = 0;                              // root mean square of error over sigma
};

// Matches a lattice of points from guesses up to a pixel (of the coarser photo) off the truth.
Score score(const Pair& pair) {
  Score result;
  const double scale = scale_of(pair.jacobian);
  const double unit = std::max(1.0, scale);
  double squares = 0, normalised = 0;
  const double reach = 0.29 * kSide_px * std::min(1.0, 1.0 / scale);
  for (int i = -7; i <= 7; ++i) {
    for (int j = -7; j <= 7; ++j) {
      const Eigen::Vector2d reference(std::round(kSide_px / 2.0 + i * reach / 7),
                                      std::round(kSide_px / 2.0 + j * reach / 7));
      const Eigen::Vector2d truth = pair.second_of(reference);
      const Eigen::Vector2d off(unit * std::sin(i * 3.0 + j), unit * std::cos(i + 5.0 * j));
      Eigen::Matrix2d guess = pair.jacobian;
      guess.row(0) *= 1.03;
      ++result.tried;
      const auto match = match_patch(pair.first, pair.second, {reference, truth + off, guess}, {});
      if (!match) continue;
      ++result.matched;
      const Eigen::Vector2d error = match->map.target_px - truth;
      const Eigen::Matrix2d covariance =
          match->target_covariance_px2 +
          pair.jacobian * match->reference_covariance_px2 * pair.jacobian.transpose();
      result.bias_px += error / unit;
      squares += error.squaredNorm() / (2 * unit * unit);
      normalised += error.dot(covariance.inverse() * error) / 2;
    }
  }
  result.bias_px /= std::max(result.matched, 1);
  result.rms_px = std::sqrt(squares / std::max(result.matched, 1));
  result.normalised = std::sqrt(normalised / std::max(result.matched, 1));
  return result;
}

struct Case {
  double scale;
  double turn_deg;
  double noise_grey;
  int jpeg_quality;  // 0 = none
};

class LeastSquaresMatchingOver : public testing::TestWithParam<Case> {};

TEST_P(LeastSquaresMatchingOver, MeetsTheTruthWithinItsStatedSigmaAndWithoutBias) {
  const Case& given = GetParam();
  const Score got =
      score(make_pair(given.scale, given.turn_deg, given.noise_grey, given.jpeg_quality, 7));
  RecordProperty("rms_mpx", static_cast<int>(1000 * got.rms_px));
  printf(
      "scale %.2f turn %.0f noise %.0f jpeg %d: matched %d of %d, rms %.4f px, bias %.4f %.4f px, "
      "error/sigma %.2f\n",
      given.scale, given.turn_deg, given.noise_grey, given.jpeg_quality, got.matched, got.tried,
      got.rms_px, got.bias_px.x(), got.bias_px.y(), got.normalised);
  EXPECT_GT(got.matched, got.tried * 9 / 10);
  EXPECT_LT(got.rms_px, given.jpeg_quality > 0 ? 0.10 : 0.06);
  // Without turn or change of scale all samples of a patch share one place between the pixels, and
  // the error of interpolation does not average out.
  EXPECT_LT(got.bias_px.norm(), given.scale == 1.0 ? 0.03 : 0.02);
  EXPECT_GT(got.normalised, 0.35);
  EXPECT_LT(got.normalised, 1.6);
}

INSTANTIATE_TEST_SUITE_P(ScalesTurnsAndNoise, LeastSquaresMatchingOver,
                         testing::Values(Case{1.0, 0, 2, 0}, Case{1.1, 10, 2, 0},
                                         Case{1 / 1.1, -20, 2, 0}, Case{1.3, 45, 2, 0},
                                         Case{2.0, 130, 2, 0}, Case{0.5, -100, 2, 0},
                                         Case{3.0, 20, 2, 0}, Case{1 / 3.0, 200, 2, 0},
                                         Case{1.3, 30, 6, 0}, Case{1.3, 30, 2, 85},
                                         Case{1 / 1.3, 30, 2, 85}, Case{1 / 3.0, 30, 2, 85}));

// cv::findTransformECC (Evangelidis and Psarakis 2008) maximises another figure by other code.
TEST(LeastSquaresMatching, AgreesWithEnhancedCorrelationOfOpenCv) {
  const Pair pair = make_pair(1.15, 12, 2, 0, 11);
  constexpr int kHalf = 14;
  MatchOptions options;
  options.half_size = kHalf;
  double squares = 0;
  int compared = 0;
  for (int k = 0; k < 12; ++k) {
    const Eigen::Vector2d reference(70 + 38 * (k % 4), 80 + 45 * (k / 4));
    const auto match = match_patch(pair.first, pair.second,
                                   {reference, pair.second_of(reference), pair.jacobian}, options);
    ASSERT_TRUE(match);
    const cv::Rect square(static_cast<int>(reference.x()) - kHalf,
                          static_cast<int>(reference.y()) - kHalf, 2 * kHalf + 1, 2 * kHalf + 1);
    const Eigen::Vector2d corner = pair.second_of(Eigen::Vector2d(square.x, square.y));
    cv::Mat warp(2, 3, CV_32F);
    for (int row = 0; row < 2; ++row) {
      warp.at<float>(row, 0) = static_cast<float>(pair.jacobian(row, 0));
      warp.at<float>(row, 1) = static_cast<float>(pair.jacobian(row, 1));
      warp.at<float>(row, 2) = static_cast<float>(corner(row));
    }
    cv::findTransformECC(
        pair.first(square), pair.second, warp, cv::MOTION_AFFINE,
        cv::TermCriteria(cv::TermCriteria::COUNT | cv::TermCriteria::EPS, 100, 1e-7), cv::noArray(),
        3);
    const Eigen::Vector2d theirs(
        (warp.at<float>(0, 0) + warp.at<float>(0, 1)) * kHalf + warp.at<float>(0, 2),
        (warp.at<float>(1, 0) + warp.at<float>(1, 1)) * kHalf + warp.at<float>(1, 2));
    squares += (theirs - match->map.target_px).squaredNorm() / 2;
    ++compared;
  }
  EXPECT_LT(std::sqrt(squares / compared), 0.03);
}

TEST(LeastSquaresMatching, FindsNothingOnBlankGround) {
  const cv::Mat blank(100, 100, CV_8UC1, cv::Scalar(120));
  const LocalMap guess{{50, 50}, {50, 50}, Eigen::Matrix2d::Identity()};
  EXPECT_FALSE(match_patch(blank, blank, guess, {}));
}

TEST(LeastSquaresMatching, FindsNothingBeyondTheEdgeOfAPhoto) {
  const Pair pair = make_pair(1.0, 0, 2, 0, 3);
  for (const double u : {-1e9, -20.0, 0.0, 3.0, 258.0, 1e9}) {
    const LocalMap guess{{130, 130}, {u, 130}, Eigen::Matrix2d::Identity()};
    EXPECT_FALSE(match_patch(pair.first, pair.second, guess, {}));
  }
}

TEST(LeastSquaresMatching, DoesNotMatchTheSameKindOfGroundElsewhere) {
  const Pair pair = make_pair(1.1, 0, 2, 0, 5);
  int wrong = 0;
  for (int k = 0; k < 100; ++k) {
    const Eigen::Vector2d reference(35 + 20 * (k % 10), 35 + 20 * (k / 10));
    const Eigen::Vector2d elsewhere(225 - 20 * (k / 10), 215 - 19 * (k % 10));
    if ((elsewhere - pair.second_of(reference)).norm() < 20) continue;
    wrong +=
        match_patch(pair.first, pair.second, {reference, elsewhere, pair.jacobian}, {}) ? 1 : 0;
  }
  EXPECT_LE(wrong, 1);
}

}  // namespace
}  // namespace plumbline::image
