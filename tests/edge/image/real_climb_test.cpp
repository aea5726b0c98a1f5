// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <opencv2/imgproc.hpp>
#include <opencv2/video/tracking.hpp>
#include <vector>

#include "edge/image/tie_points.h"
#include "edge/jpeg/jpeg.h"

namespace plumbline::image {
namespace {

std::filesystem::path shared_folder() {
  const char* given = std::getenv("PLUMBLINE_SHARED");
  return given != nullptr ? given : PLUMBLINE_SHARED_BESIDE;
}

// The first photos of the real climb at half size, to keep the test quick.
std::vector<Image> half_size_photos(const std::filesystem::path& folder, std::size_t count) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().extension() == ".jpg") files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  files.resize(std::min(files.size(), count));
  std::vector<Image> photos;
  for (const auto& file : files) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes((std::istreambuf_iterator<char>(stream)), {});
    const Image full =
        jpeg::decode_grey({reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size()},
                          file.filename().string())
            .value();
    const cv::Mat view(full.height_px, full.width_px, CV_8UC1,
                       const_cast<std::uint8_t*>(full.data.data()));
    cv::Mat half;
    cv::resize(view, half, {}, 0.5, 0.5, cv::INTER_AREA);
    photos.push_back({half.cols, half.rows, 1, {half.datastart, half.dataend}});
  }
  return photos;
}

std::map<int, Eigen::Vector2d> pixels_in(const TiePoints& ties, int photo) {
  std::map<int, Eigen::Vector2d> pixels;
  for (const TieObservation& one : ties.observations)
    if (one.photo == photo) pixels[one.point] = one.pixel;
  return pixels;
}

cv::Point2f point_of(const Eigen::Vector2d& pixel) {
  return {static_cast<float>(pixel.x()), static_cast<float>(pixel.y())};
}

cv::Mat mat_of(const Image& image) {
  return {image.height_px, image.width_px, CV_8UC1, const_cast<std::uint8_t*>(image.data.data())};
}

Eigen::Matrix3d homography_of(const TiePoints& ties, int first, int second) {
  for (const PhotoPair& pair : ties.pairs)
    if (pair.first == first && pair.second == second) return pair.second_from_first;
  ADD_FAILURE() << "photos " << first << " and " << second << " were not found to overlap";
  return Eigen::Matrix3d::Identity();
}

// Optical flow takes a change of light for motion: greys here are relative to their surroundings.
cv::Mat without_light(const cv::Mat& photo) {
  cv::Mat values, mean, spread, result;
  photo.convertTo(values, CV_32F);
  cv::GaussianBlur(values, mean, {}, 12);
  values -= mean;
  cv::GaussianBlur(values.mul(values), spread, {}, 12);
  cv::sqrt(spread, spread);
  cv::divide(40 * values, spread + 1, values);
  values.convertTo(result, CV_8U, 1, 128);
  return result;
}

// Distances between the ties of two photos and OpenCV's optical flow, which starts two pixels off
// and sees the second photo in the first one's geometry.
std::vector<double> distances_to_flow(const TiePoints& ties, const std::vector<Image>& photos,
                                      int first) {
  const Eigen::Matrix3d homography = homography_of(ties, first, first + 1);
  cv::Matx33d warp;
  for (int k = 0; k < 9; ++k) warp(k / 3, k % 3) = homography(k / 3, k % 3);
  const cv::Mat before = mat_of(photos[static_cast<std::size_t>(first)]);
  cv::Mat after;
  cv::warpPerspective(mat_of(photos[static_cast<std::size_t>(first) + 1]), after, warp,
                      before.size(), cv::INTER_CUBIC | cv::WARP_INVERSE_MAP);
  const auto from = pixels_in(ties, first), to = pixels_in(ties, first + 1);
  std::vector<cv::Point2f> start, goal, flow;
  for (const auto& [point, pixel] : from) {
    if (to.count(point) == 0) continue;
    start.push_back(point_of(pixel));
    goal.push_back(point_of((homography.inverse() * to.at(point).homogeneous()).hnormalized()));
    flow.push_back(goal.back() + cv::Point2f(1.5F, -1.5F));
  }
  std::vector<std::uint8_t> status;
  std::vector<double> distances;
  if (start.empty()) return distances;
  cv::calcOpticalFlowPyrLK(without_light(before), without_light(after), start, flow, status,
                           cv::noArray(), {19, 19}, 1, {3, 50, 0.001},
                           cv::OPTFLOW_USE_INITIAL_FLOW);
  for (std::size_t i = 0; i < flow.size(); ++i)
    if (status[i] != 0) distances.push_back(cv::norm(flow[i] - goal[i]));
  return distances;
}

TEST(RealClimb, IsTiedTogetherInAgreementWithOpticalFlow) {
  const auto folder = shared_folder() / "data" / "climb";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " with the real climb is absent";
  const std::vector<Image> photos = half_size_photos(folder, 5);
  const auto source = [&](int i) -> Result<Image> { return photos[static_cast<std::size_t>(i)]; };
  TieOptions options;
  options.ties_wanted = 1000;
  options.threads = 2;
  const auto ties = find_tie_points(source, static_cast<int>(photos.size()), options, {});
  ASSERT_TRUE(ties.ok());
  EXPECT_EQ(ties->component, std::vector<int>(photos.size(), 0));
  std::map<int, int> rays;
  for (const TieObservation& one : ties->observations) ++rays[one.point];
  const auto in_three =
      std::count_if(rays.begin(), rays.end(), [](const auto& entry) { return entry.second >= 3; });
  EXPECT_GE(ties->point_count, 600);
  EXPECT_GE(in_three, 300);
  for (int first = 0; first + 1 < static_cast<int>(photos.size()); ++first) {
    std::vector<double> distances = distances_to_flow(*ties, photos, first);
    ASSERT_GE(distances.size(), 100U);
    std::sort(distances.begin(), distances.end());
    printf("photos %d and %d: %zu points, median %.3f px, nine tenths %.3f px\n", first, first + 1,
           distances.size(), distances[distances.size() / 2], distances[distances.size() * 9 / 10]);
    EXPECT_LT(distances[distances.size() / 2], 0.25);
    EXPECT_LT(distances[distances.size() * 9 / 10], 0.6);
  }
}

}  // namespace
}  // namespace plumbline::image
