// SPDX-License-Identifier: MIT
#include "edge/geometry/camera.h"

#include <gtest/gtest.h>

#include <opencv2/calib3d.hpp>
#include <random>

namespace plumbline::geometry {
namespace {

InteriorVector strongly_distorted() {
  InteriorVector c;
  c << 2125, 2010.5, 1118.25, 0.004, 0, -0.11, 0.07, -0.02, 0.0008, -0.0006;
  return c;
}

// OpenCV knows no skew: it is checked by hand below.
cv::Point2d opencv_pixel(const InteriorVector& c, const Eigen::Vector3d& p) {
  const cv::Matx33d camera(c[kFocalLength], 0, c[kPrincipalU], 0,
                           c[kFocalLength] * (1 + c[kAffinity]), c[kPrincipalV], 0, 0, 1);
  const cv::Mat distortion = (cv::Mat_<double>(1, 5) << c[kRadial1], c[kRadial2], c[kTangential1],
                              c[kTangential2], c[kRadial3]);
  // OpenCV's camera frame is x right, y down, z ahead.
  const std::vector<cv::Point3d> points = {{p.x(), -p.y(), -p.z()}};
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(points, cv::Vec3d(0, 0, 0), cv::Vec3d(0, 0, 0), camera, distortion, pixels);
  return pixels.front();
}

TEST(Camera, ProjectsAsOpenCvDoes) {
  const InteriorVector c = strongly_distorted();
  std::mt19937_64 random(2);
  std::uniform_real_distribution<double> across(-60, 60), depth(60, 90);
  for (int i = 0; i < 200; ++i) {
    const Eigen::Vector3d point(across(random), across(random) * 0.6, -depth(random));
    const auto pixel = project(c, point);
    ASSERT_TRUE(pixel);
    const cv::Point2d expected = opencv_pixel(c, point);
    EXPECT_NEAR(pixel->x(), expected.x, 1e-9);
    EXPECT_NEAR(pixel->y(), expected.y, 1e-9);
  }
}

TEST(Camera, SkewMovesUByTheSkewTimesFTimesY) {
  InteriorVector c = InteriorVector::Zero();
  c[kFocalLength] = 1000;
  c[kSkew] = 0.01;
  // y = -Y / -Z = -0.2 (image y is down), so u = 1000 (0.1 + 0.01 * -0.2) = 98.
  const auto pixel = project(c, {1, 2, -10});
  ASSERT_TRUE(pixel);
  EXPECT_NEAR(pixel->x(), 98.0, 1e-12);
  EXPECT_NEAR(pixel->y(), -200.0, 1e-12);
}

TEST(Camera, SeesNothingBehindItOrWhereItsDistortionFoldsBack) {
  InteriorVector c = InteriorVector::Zero();
  c[kFocalLength] = 1000;
  EXPECT_FALSE(project(c, {0, 0, 1}));
  EXPECT_FALSE(project(c, {0, 0, 0}));
  c[kRadial1] = -0.5;  // folds at r2 = 1 / 1.5
  EXPECT_TRUE(project(c, {0.8, 0, -1}));
  EXPECT_FALSE(project(c, {0.82, 0, -1}));
}

TEST(Camera, DerivativesAgreeWithDifferences) {
  InteriorVector c = strongly_distorted();
  c[kSkew] = 0.002;
  const Eigen::Vector3d point(21, -13, -78);
  const auto projection = project_with_derivatives(c, point);
  ASSERT_TRUE(projection);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d step = 1e-4 * Eigen::Vector3d::Unit(i);
    const Eigen::Vector2d slope = (*project(c, point + step) - *project(c, point - step)) / 2e-4;
    EXPECT_LT((slope - projection->by_point.col(i)).norm(), 1e-6) << i;
  }
  for (int i = 0; i < kInteriorCount; ++i) {
    InteriorVector step = InteriorVector::Zero();
    step[i] = i <= kPrincipalV ? 1e-2 : 1e-6;
    const Eigen::Vector2d slope =
        (*project(c + step, point) - *project(c - step, point)) / (2 * step[i]);
    EXPECT_LT((slope - projection->by_interior.col(i)).norm(),
              1e-6 * (1 + projection->by_interior.col(i).norm()))
        << kInteriorNames[static_cast<std::size_t>(i)];
  }
}

TEST(Camera, RayOfAPixelProjectsBackOntoIt) {
  InteriorVector c = strongly_distorted();
  c[kSkew] = 0.002;
  for (double u = 0; u < 4000; u += 399) {
    for (double v = 0; v < 2250; v += 224) {
      const auto ray = ray_in_photo(c, {u, v});
      ASSERT_TRUE(ray);
      EXPECT_LT((*project(c, *ray * 70) - Eigen::Vector2d(u, v)).norm(), 1e-9);
    }
  }
}

TEST(Camera, HasNoRayForAPixelThatNoDirectionReaches) {
  InteriorVector c = InteriorVector::Zero();
  c[kFocalLength] = 1000;
  c[kRadial1] = -0.5;  // reaches at most r (1 - r2 / 2) = 0.544 there
  EXPECT_TRUE(ray_in_photo(c, {540, 0}));
  EXPECT_FALSE(ray_in_photo(c, {600, 0}));
}

}  // namespace
}  // namespace plumbline::geometry
