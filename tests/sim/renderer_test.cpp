// SPDX-License-Identifier: MIT
#include "sim/renderer.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>
#include <opencv2/calib3d.hpp>
#include <vector>

#include "small_flight.h"

namespace plumbline::sim {
namespace {

// Ground to pixels by OpenCV alone. OpenCV's camera looks along +z with y down: x_cv = x_photo,
// y_cv = -y_photo, z_cv = -z_photo, where the photo frame has rows of the transposed rotation.
std::vector<cv::Point2d> seen_by_opencv(const Flight& flight, std::size_t photo,
                                        const std::vector<cv::Point3d>& ground_m) {
  const geometry::Pose& pose = flight.shots[photo].pose;
  const Eigen::Matrix3d& r = pose.ground_from_photo;
  const cv::Matx33d cv_from_ground(r(0, 0), r(1, 0), r(2, 0),     //
                                   -r(0, 1), -r(1, 1), -r(2, 1),  //
                                   -r(0, 2), -r(1, 2), -r(2, 2));
  cv::Vec3d turn;
  cv::Rodrigues(cv_from_ground, turn);
  const cv::Vec3d centre(pose.centre_m.x(), pose.centre_m.y(), pose.centre_m.z());
  const cv::Vec3d shift = -(cv_from_ground * centre);
  const auto& c = flight.camera.interior;
  const cv::Matx33d camera(c[0], 0, c[1], 0, c[0], c[2], 0, 0, 1);
  const std::vector<double> distortion{c[5], c[6], c[8], c[9], c[7]};
  std::vector<cv::Point2d> pixels;
  cv::projectPoints(ground_m, turn, shift, camera, distortion, pixels);
  return pixels;
}

std::vector<cv::Point3d> rim_m(const Target& target) {
  // Two unit vectors across each other within the plate's plane.
  const Eigen::Vector3d normal =
      Eigen::Vector3d(-target.slope.x(), -target.slope.y(), 1).normalized();
  const Eigen::Vector3d a = normal.cross(Eigen::Vector3d::UnitX()).normalized();
  const Eigen::Vector3d b = normal.cross(a);
  std::vector<cv::Point3d> rim;
  for (int k = 0; k < 720; ++k) {
    const double t = 2 * std::numbers::pi * k / 720;
    const Eigen::Vector3d p =
        target.centre_m + target.disc_radius_m * (std::cos(t) * a + std::sin(t) * b);
    rim.emplace_back(p.x(), p.y(), p.z());
  }
  return rim;
}

// Centroid of the area within a polygon.
cv::Point2d centroid(const std::vector<cv::Point2d>& corners) {
  const cv::Point2d base = corners.front();
  double area = 0;
  cv::Point2d sum(0, 0);
  for (std::size_t k = 0; k < corners.size(); ++k) {
    const cv::Point2d p = corners[k] - base;
    const cv::Point2d q = corners[(k + 1) % corners.size()] - base;
    const double cross = p.x * q.y - q.x * p.y;
    area += cross;
    sum += cross * (p + q);
  }
  return base + sum / (3 * area);
}

// Centroid of the light above black, over a circle that the plate fills.
cv::Point2d light_centroid(const Image& image, const cv::Point2d& near, double radius_px) {
  double black = 255;
  for (int pass = 0; pass < 2; ++pass) {
    double light = 0;
    cv::Point2d sum(0, 0);
    for (int v = 0; v < image.height_px; ++v) {
      for (int u = 0; u < image.width_px; ++u) {
        if (std::hypot(u - near.x, v - near.y) > radius_px) continue;
        const double grey = image.data[image.index(u, v) + 1];
        if (pass == 0) black = std::min(black, grey);
        light += grey - black;
        sum += (grey - black) * cv::Point2d(u - near.x, v - near.y);
      }
    }
    if (pass == 1) return near + sum / light;
  }
  return near;
}

TEST(Renderer, ShowsTargetsWhereOpenCvProjectsThem) {
  Profile profile = small_profile();
  profile.noise = 0;
  profile.vignetting = 0;
  const Flight flight = fly(profile, 11);
  const World world(world_for(profile, 11, 2), std::nullopt);
  int compared = 0;
  for (std::size_t photo = 0; photo < flight.shots.size(); ++photo) {
    const Image image = photograph(world, flight, photo, 2);
    for (const Target& target : world.targets()) {
      if (!seen_at(world, flight, photo, target)) continue;
      const auto rim = seen_by_opencv(flight, photo, rim_m(target));
      const cv::Point2d expected = centroid(rim);
      const double radius_px = 1.3 * cv::norm(rim.front() - expected);
      const cv::Point2d found = light_centroid(image, expected, radius_px);
      EXPECT_NEAR(found.x, expected.x, 0.01) << target.name << " in " << flight.shots[photo].photo;
      EXPECT_NEAR(found.y, expected.y, 0.01) << target.name << " in " << flight.shots[photo].photo;
      ++compared;
    }
  }
  EXPECT_GT(compared, 15);
}

TEST(Renderer, AgreesWithOpenCvOnThePixelOfATargetsCentre) {
  const Flight flight = fly(small_profile(), 12);
  const World world(world_for(small_profile(), 12, 2), std::nullopt);
  int compared = 0;
  for (const Target& target : world.targets()) {
    const auto pixel = seen_at(world, flight, 0, target);
    if (!pixel) continue;
    const cv::Point3d centre(target.centre_m.x(), target.centre_m.y(), target.centre_m.z());
    const cv::Point2d expected = seen_by_opencv(flight, 0, {centre}).front();
    EXPECT_NEAR(pixel->x(), expected.x, 1e-6);
    EXPECT_NEAR(pixel->y(), expected.y, 1e-6);
    ++compared;
  }
  EXPECT_GT(compared, 3);
}

TEST(Renderer, GivesTheSameBytesForOneThreadAndForTwo) {
  Profile profile = small_profile();
  profile.motion_blur_px = 3;
  const Flight flight = fly(profile, 4);
  const World one(world_for(profile, 4, 1), std::nullopt);
  const World two(world_for(profile, 4, 2), std::nullopt);
  EXPECT_EQ(photograph(one, flight, 1, 1).data, photograph(two, flight, 1, 2).data);
}

TEST(Renderer, MakesNoiseOfTheVarianceItWasGiven) {
  Profile profile = small_profile();
  profile.vignetting = 0;
  profile.noise = 0;
  const World world(world_for(profile, 4, 2), std::nullopt);
  const Image clean = photograph(world, fly(profile, 4), 0, 2);
  profile.noise = 2;
  const Image noisy = photograph(world, fly(profile, 4), 0, 2);
  double sum = 0, squares = 0;
  int count = 0;
  for (std::size_t k = 0; k < clean.data.size(); ++k) {
    if (clean.data[k] < 118 || clean.data[k] > 122) continue;
    const double difference = static_cast<double>(noisy.data[k]) - clean.data[k];
    sum += difference;
    squares += difference * difference;
    ++count;
  }
  // 4 (1 + 0.013 * 120), and 1/12 for each of the two roundings.
  EXPECT_NEAR(squares / count, 4 * (1 + 0.013 * 120) + 2.0 / 12, 0.3);
  EXPECT_NEAR(sum / count, 0, 0.1);
}

TEST(Renderer, TakesAPhotoAsGround) {
  const Profile profile = small_profile();
  Image plain{128, 96, 3, std::vector<std::uint8_t>(128 * 96 * 3, 0)};
  for (std::size_t k = 0; k < plain.data.size(); k += 3) plain.data[k] = 200;  // red
  const World world(world_for(profile, 4, 2), plain);
  const Image image = photograph(world, fly(profile, 4), 0, 2);
  double red = 0, green = 0;
  for (std::size_t k = 0; k < image.data.size(); k += 3) {
    red += image.data[k];
    green += image.data[k + 1];
  }
  EXPECT_GT(red, 5 * green);
}

}  // namespace
}  // namespace plumbline::sim
