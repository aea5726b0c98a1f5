// SPDX-License-Identifier: MIT
#include "edge/survey/survey.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "edge/geometry/rotation.h"

namespace plumbline::survey {
namespace {

constexpr int kWidthPx = 640;
constexpr int kHeightPx = 480;

// A hash of a lattice place in [0, 1).
double speck(std::int64_t i, std::int64_t j) {
  std::uint64_t h = static_cast<std::uint64_t>(i) * 0x9E3779B97F4A7C15U ^
                    static_cast<std::uint64_t>(j) * 0xC2B2AE3D27D4EB4FU;
  h = (h ^ (h >> 31)) * 0xD6E8FEB86659FD93U;
  return static_cast<double>((h ^ (h >> 32)) >> 11) * 0x1p-53;
}

// Smooth random values with a lattice of `cell_m`.
double smooth_noise(double e, double n, double cell_m) {
  const double x = e / cell_m, y = n / cell_m;
  const double i = std::floor(x), j = std::floor(y);
  const auto ease = [](double t) { return t * t * (3 - 2 * t); };
  const double u = ease(x - i), v = ease(y - j);
  const auto a = static_cast<std::int64_t>(i), b = static_cast<std::int64_t>(j);
  return (1 - v) * ((1 - u) * speck(a, b) + u * speck(a + 1, b)) +
         v * ((1 - u) * speck(a, b + 1) + u * speck(a + 1, b + 1));
}

double grey(double e, double n) {
  return 255 * (0.4 * smooth_noise(e, n, 3.1) + 0.35 * smooth_noise(e + 50, n, 1.1) +
                0.25 * smooth_noise(e, n + 70, 0.45));
}

// Four photos from 30 to 48 m above level ground, the last one aside, with good fixes.
struct Scene {
  Scene() {
    input.camera.name = "made";
    input.camera.width_px = kWidthPx;
    input.camera.height_px = kHeightPx;
    input.camera.interior << 520, 319.5, 239.5, 0, 0, 0, 0, 0, 0, 0;
    input.camera.sigma << 0.5, 0.5, 0.5, 0, 0, 0, 0, 0, 0, 0;
    add_photo({0, 0, 30}, {0.01, -0.02, 0.3});
    add_photo({0.5, 0.3, 36}, {-0.01, 0.01, 0.32});
    add_photo({0.8, -0.4, 42}, {0.02, 0.0, 0.28});
    add_photo({9, 4, 48}, {-0.01, 0.02, 0.31});
    input.images = [this](int photo) { return render(photo); };
  }

  void add_photo(const Eigen::Vector3d& centre_m, const geometry::OmegaPhiKappa& angles) {
    poses.push_back({centre_m, geometry::ground_from_photo(angles)});
    orient::Photo photo;
    photo.name = "photo" + std::to_string(poses.size());
    photo.station = orient::Station{centre_m, 1e-4 * Eigen::Matrix3d::Identity()};
    input.photos.push_back(photo);
  }

  Result<Image> render(int photo) const {
    const geometry::Pose& pose = poses[static_cast<std::size_t>(photo)];
    Image image{kWidthPx, kHeightPx, 1, {}};
    for (int v = 0; v < kHeightPx; ++v) {
      for (int u = 0; u < kWidthPx; ++u) {
        const Eigen::Vector3d ray =
            pose.ground_from_photo * *geometry::ray_in_photo(input.camera.interior, {u, v});
        const Eigen::Vector3d ground = pose.centre_m - ray * (pose.centre_m.z() / ray.z());
        image.data.push_back(static_cast<std::uint8_t>(std::lround(grey(ground.x(), ground.y()))));
      }
    }
    return image;
  }

  void pick(int photo, const std::string& point, const Eigen::Vector3d& ground) {
    const geometry::Pose& pose = poses[static_cast<std::size_t>(photo)];
    const auto pixel = geometry::project(
        input.camera.interior, pose.ground_from_photo.transpose() * (ground - pose.centre_m));
    input.picks.push_back({photo, point, *pixel, std::nullopt});
  }

  Input input;
  std::vector<geometry::Pose> poses;
};

Options few_ties() {
  Options options;
  options.ties.ties_wanted = 200;
  return options;
}

const Progress kSilent = [](const auto&...) {};

bool has(const std::string& sentence, const std::string& words) {
  return sentence.find(words) != std::string::npos;
}

TEST(Survey, MeasuresPicksAndTiesOfAMadeClimb) {
  Scene scene;
  const Eigen::Vector3d often(6, -5, 0), once(-5, 4, 0);
  for (int photo = 0; photo < 4; ++photo) scene.pick(photo, "often", often);
  scene.pick(0, "once", once);
  const auto survey = measure(scene.input, few_ties(), kSilent);
  ASSERT_TRUE(survey) << survey.error().sentence;
  ASSERT_GE(survey->problem.point_names.size(), 2U);
  EXPECT_EQ(survey->problem.point_names[0], "often");
  EXPECT_EQ(survey->problem.point_names[1], "once");
  EXPECT_EQ(survey->problem.point_names[2], "T1");
  const Eigen::Vector3d truths[] = {often, once};
  for (std::size_t p = 0; p < 2; ++p) {
    const auto& point = survey->solution.points[p];
    ASSERT_TRUE(point.measured) << p;
    const Eigen::Vector3d sigma = point.covariance_m2.diagonal().cwiseSqrt();
    const Eigen::Vector3d error = point.in_enu_m - truths[p];
    EXPECT_LT(error.cwiseQuotient(sigma).cwiseAbs().maxCoeff(), 4) << p;
    EXPECT_LT(error.norm(), 0.3) << p;
  }
  EXPECT_EQ(survey->solution.points[0].rays, 4);
  EXPECT_GE(survey->solution.points[1].rays, 2);
}

TEST(Survey, CountsPhotosAndTiesButNoPicksAmongTies) {
  Scene scene;
  scene.pick(0, "once", {-5, 4, 0});
  const auto survey = measure(scene.input, few_ties(), kSilent);
  ASSERT_TRUE(survey) << survey.error().sentence;
  const Counts& counts = survey->counts;
  EXPECT_EQ(counts.photos_given, 4);
  EXPECT_EQ(counts.photos_used, 4);
  int measured = 0, three = 0;
  for (std::size_t p = 0; p < survey->solution.points.size(); ++p) {
    const auto& point = survey->solution.points[p];
    if (survey->problem.point_names[p] == "once" || !point.measured) continue;
    ++measured;
    three += point.rays >= 3 ? 1 : 0;
  }
  EXPECT_EQ(counts.tie_points, measured);
  EXPECT_EQ(counts.tie_points_3plus, three);
  EXPECT_GT(counts.tie_points, 50);
}

TEST(Survey, RefusesALengthBetweenPointsThatNobodyPicked) {
  Scene scene;
  scene.pick(0, "A", {2, 3, 0});
  scene.pick(1, "A", {2, 3, 0});
  scene.input.lengths.push_back({"A", "ghost", 4.0, 0.001});
  const auto survey = measure(scene.input, few_ties(), kSilent);
  ASSERT_FALSE(survey);
  EXPECT_TRUE(has(survey.error().sentence, "ghost")) << survey.error().sentence;
  EXPECT_TRUE(has(survey.error().sentence, "not picked")) << survey.error().sentence;
}

TEST(Survey, SaysThatBlankPhotosDoNotOverlap) {
  Scene scene;
  scene.input.images = [](int) -> Result<Image> {
    return Image{kWidthPx, kHeightPx, 1,
                 std::vector<std::uint8_t>(std::size_t{kWidthPx} * kHeightPx, 128)};
  };
  const auto survey = measure(scene.input, few_ties(), kSilent);
  ASSERT_FALSE(survey);
  EXPECT_TRUE(has(survey.error().sentence, "do not overlap")) << survey.error().sentence;
}

TEST(Survey, HandsOnWhyAPhotoCannotBeLoaded) {
  Scene scene;
  scene.input.images = [](int) -> Result<Image> { return Error{"photo3.jpg is cut short."}; };
  const auto survey = measure(scene.input, few_ties(), kSilent);
  ASSERT_FALSE(survey);
  EXPECT_TRUE(has(survey.error().sentence, "photo3.jpg is cut short"));
}

TEST(Survey, NamesTiesApartFromAPickCalledLikeOne) {
  Scene scene;
  for (int photo = 0; photo < 3; ++photo) scene.pick(photo, "T7", {2, 3, 0});
  const auto survey = measure(scene.input, few_ties(), kSilent);
  ASSERT_TRUE(survey) << survey.error().sentence;
  auto names = survey->problem.point_names;
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::adjacent_find(names.begin(), names.end()), names.end());
}

}  // namespace
}  // namespace plumbline::survey
