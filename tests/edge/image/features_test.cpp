// SPDX-License-Identifier: MIT
#include "edge/image/features.h"

#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <opencv2/features2d.hpp>
#include <opencv2/imgproc.hpp>

namespace plumbline::image {
namespace {

constexpr int kAll = 1'000'000;

// Noise of every size from 1 to 32 pixels, each with the same contrast.
PhotoLevels ground(int width_px, int height_px) {
  cv::RNG random(20181128);
  cv::Mat sum(height_px, width_px, CV_32F, cv::Scalar(128));
  for (int size = 1; size <= 32; size *= 2) {
    cv::Mat noise((height_px + size - 1) / size, (width_px + size - 1) / size, CV_32F);
    random.fill(noise, cv::RNG::NORMAL, 0, 15);
    cv::resize(noise, noise, sum.size(), 0, 0, cv::INTER_CUBIC);
    sum += noise;
  }
  PhotoLevels photo;
  photo.level.emplace_back();
  sum.convertTo(photo.level.back(), CV_8U);
  return photo;
}

// OpenCV's SIFT of the whole picture at once.
struct WholePicture {
  explicit WholePicture(const PhotoLevels& photo) {
    const auto sift = cv::SIFT::create(0, 3, 0.02);
    sift->detectAndCompute(photo.full(), cv::noArray(), points, descriptors);
  }
  // The cosine between its descriptor at a place, within a quarter of a pixel, and another one; of
  // several directions there the nearest. -1: it has none there.
  double likeness(const Eigen::Vector2d& place_px, const Eigen::VectorXf& descriptor) const {
    double best = -1;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (std::hypot(points[i].pt.x - place_px.x(), points[i].pt.y - place_px.y()) > 0.25) continue;
      const Eigen::Map<const Eigen::VectorXf> own(descriptors.ptr<float>(static_cast<int>(i)),
                                                  descriptors.cols);
      best = std::max(best, static_cast<double>(own.dot(descriptor) / own.norm()));
    }
    return best;
  }

  std::vector<cv::KeyPoint> points;
  cv::Mat descriptors;
};

TEST(Features, AreThoseOfTheWholePictureAlthoughItIsSearchedInParts) {
  const PhotoLevels photo = ground(1300, 900);
  const WholePicture whole(photo);
  const Features features = detect_features(photo, kAll);
  ASSERT_GT(whole.points.size(), 2000u);
  const auto count = static_cast<double>(features.place_px.size());
  EXPECT_NEAR(count / static_cast<double>(whole.points.size()), 1, 0.02);
  int alike = 0;
  for (std::size_t i = 0; i < features.place_px.size(); ++i) {
    const Eigen::VectorXf descriptor = features.descriptors.col(static_cast<Eigen::Index>(i));
    alike += whole.likeness(features.place_px[i], descriptor) > 0.99 ? 1 : 0;
  }
  EXPECT_GT(alike / count, 0.97);
}

TEST(Features, AreTheStrongestSpreadOverThePicture) {
  const PhotoLevels photo = ground(1300, 900);
  const Features features = detect_features(photo, 400);
  ASSERT_EQ(features.place_px.size(), 400u);
  int left = 0, upper = 0;
  for (const Eigen::Vector2d& place : features.place_px) {
    left += place.x() < 650 ? 1 : 0;
    upper += place.y() < 450 ? 1 : 0;
  }
  EXPECT_NEAR(left, 200, 60);
  EXPECT_NEAR(upper, 200, 60);
}

// Megabytes that a process of its own has had in memory at most.
double most_memory_mb(const std::function<void()>& work) {
  const pid_t process = ::fork();
  if (process == 0) {
    cv::setNumThreads(1);  // those of the parent are not there
    work();
    ::_exit(0);
  }
  rusage used{};
  int status = -1;
  ::wait4(process, &status, 0, &used);
  EXPECT_EQ(status, 0);
  return static_cast<double>(used.ru_maxrss) / 1e3;
}

// Four photos at a time, as four cores search them, beside 4 GB less what flies.
TEST(Features, TakeNoMoreThan250MegabytesAtATime) {
  if (PLUMBLINE_SANITIZED) GTEST_SKIP() << "sanitizers have memory of their own";
  const PhotoLevels photo = ground(1630, 1220);
  const double before_mb = most_memory_mb([] {});
  const double with_mb = most_memory_mb([&] { detect_features(photo, 4000); });
  EXPECT_LT(with_mb - before_mb, 250);
  RecordProperty("megabytes", static_cast<int>(with_mb - before_mb));
}

}  // namespace
}  // namespace plumbline::image
