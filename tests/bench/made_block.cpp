// SPDX-License-Identifier: MIT
#include "tests/bench/made_block.h"

#include <cmath>
#include <numeric>
#include <random>

#include "edge/base/units.h"
#include "edge/geometry/rotation.h"

namespace plumbline::bench {
namespace {

constexpr double kImageSigmaPx = 0.3;
constexpr double kStationSigmaM = 0.02;
constexpr double kControlSigmaM = 0.01;
constexpr double kTiltSigmaDeg = 2;
constexpr double kReliefM = 3;
constexpr int kLeastRays = 3;

class Maker {
 public:
  explicit Maker(std::uint64_t seed) : random_(seed) {
    geometry::Camera& camera = block_.problem.camera;
    camera.width_px = 4000;
    camera.height_px = 2250;
    truth_.interior << 2125, 2004, 1119, 1e-4, 1e-4, -0.02, 0.01, 1e-3, 2e-4, -1e-4;
    camera.sigma << 2, 2, 2, 1e-4, 1e-4, 1e-3, 1e-3, 1e-3, 2e-4, 2e-4;
    camera.interior = truth_.interior + vary<geometry::kInteriorCount>(camera.sigma);
    block_.terms.tilt_sigma_rad = kTiltSigmaDeg * kRadPerDeg;
  }

  void add_photo(const Eigen::Vector3d& centre_m, double kappa_rad) {
    const Eigen::Vector2d tilt = vary<2>(Eigen::Vector2d::Constant(kRadPerDeg));
    truth_.poses.push_back(
        {centre_m, geometry::ground_from_photo({tilt.x(), tilt.y(), kappa_rad})});
    orient::Photo photo;
    photo.name = "photo" + std::to_string(truth_.poses.size());
    photo.station = orient::Station{centre_m + vary<3>(Eigen::Vector3d::Constant(kStationSigmaM)),
                                    kStationSigmaM * kStationSigmaM * Eigen::Matrix3d::Identity()};
    block_.problem.photos.push_back(photo);
  }

  // Uniform over a rectangle about the origin, each seen by three photos or more.
  void add_points(int count, double half_east_m, double half_north_m) {
    std::uniform_real_distribution<double> uniform(-1, 1);
    while (static_cast<int>(truth_.points.size()) < count) {
      const double e = half_east_m * uniform(random_), n = half_north_m * uniform(random_);
      observe({e, n, kReliefM * std::sin(e / 9) * std::cos(n / 7)});
    }
  }

  void add_control(int count) {
    const auto points = static_cast<int>(truth_.points.size());
    for (int i = 0; i < count; ++i) {
      const int p = i * (points / count);
      block_.problem.control.push_back(
          {p, truth_.points[at(p)] + vary<3>(Eigen::Vector3d::Constant(kControlSigmaM)),
           kControlSigmaM * kControlSigmaM * Eigen::Matrix3d::Identity()});
    }
  }

  MadeBlock finish() {
    block_.start = truth_;
    block_.start.interior = block_.problem.camera.interior;
    for (geometry::Pose& pose : block_.start.poses) {
      pose.centre_m += vary<3>(Eigen::Vector3d::Constant(0.3));
      pose.ground_from_photo =
          geometry::rotation_by(vary<3>(Eigen::Vector3d::Constant(0.2 * kRadPerDeg))) *
          pose.ground_from_photo;
    }
    for (auto& point : block_.start.points) point += vary<3>(Eigen::Vector3d::Constant(0.3));
    return std::move(block_);
  }

 private:
  template <int kSize>
  Eigen::Matrix<double, kSize, 1> vary(const Eigen::Matrix<double, kSize, 1>& sigma) {
    std::normal_distribution<double> normal(0, 1);
    Eigen::Matrix<double, kSize, 1> out;
    for (int i = 0; i < kSize; ++i) out[i] = sigma[i] * normal(random_);
    return out;
  }

  void observe(const Eigen::Vector3d& point) {
    std::vector<orient::Observation> seen;
    for (std::size_t i = 0; i < truth_.poses.size(); ++i) {
      const geometry::Pose& pose = truth_.poses[i];
      const auto pixel = geometry::project(
          truth_.interior, pose.ground_from_photo.transpose() * (point - pose.centre_m));
      if (!pixel || pixel->minCoeff() < 0 || pixel->x() > 3999 || pixel->y() > 2249) continue;
      seen.push_back({static_cast<int>(i), static_cast<int>(truth_.points.size()),
                      *pixel + vary<2>(Eigen::Vector2d::Constant(kImageSigmaPx)), kImageSigmaPx,
                      orient::ImageGroup::kStated});
    }
    if (static_cast<int>(seen.size()) < kLeastRays) return;
    truth_.points.push_back(point);
    block_.problem.point_names.push_back("P" + std::to_string(truth_.points.size()));
    auto& all = block_.problem.observations;
    all.insert(all.end(), seen.begin(), seen.end());
  }

  MadeBlock block_;
  orient::State truth_;
  std::mt19937_64 random_;
};

}  // namespace

MadeBlock made_climb(int points) {
  Maker maker(7);
  for (const double height_m : {70.0, 76.0, 83.0, 90.0}) {
    maker.add_photo({0.02 * (height_m - 70), 0, height_m}, 0.3);
  }
  maker.add_photo({10, 0, 90}, 0.3);
  maker.add_points(points, 40, 25);
  return maker.finish();
}

MadeBlock made_grid(int points) {
  constexpr int kStrips = 6, kPhotosPerStrip = 10;
  constexpr double kAcrossM = 53, kAlongM = 15;
  Maker maker(8);
  for (int strip = 0; strip < kStrips; ++strip) {
    for (int i = 0; i < kPhotosPerStrip; ++i) {
      const double turned = strip % 2 == 0 ? 0.05 : 3.1;
      maker.add_photo({kAcrossM * (strip - 2.5), kAlongM * (i - 4.5), 70}, turned);
    }
  }
  maker.add_points(points, 3 * kAcrossM, 5 * kAlongM);
  maker.add_control(9);
  return maker.finish();
}

orient::Network network_of(const MadeBlock& block) {
  std::vector<int> photos(block.problem.photos.size());
  std::iota(photos.begin(), photos.end(), 0);
  return make_network(block.problem, photos);
}

orient::Minimum minimum_of(const MadeBlock& block, const orient::Network& network,
                           const orient::State& settled) {
  return minimise(network, block.start, settled, block.terms, {});
}

}  // namespace plumbline::bench
