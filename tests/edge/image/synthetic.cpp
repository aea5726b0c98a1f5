// SPDX-License-Identifier: MIT
#include "synthetic.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <opencv2/imgproc.hpp>
#include <random>

#include "edge/jpeg/jpeg.h"

namespace plumbline::image::synthetic {
namespace {

std::uint64_t mix(std::uint64_t x) {  // splitmix64
  x += 0x9E3779B97F4A7C15ULL;
  x = (x ^ (x >> 30)) * 0xBF58476D1CE4E5B9ULL;
  x = (x ^ (x >> 27)) * 0x94D049BB133111EBULL;
  return x ^ (x >> 31);
}

double lattice(std::uint64_t seed, std::int64_t i, std::int64_t j) {
  const std::uint64_t bits = mix(seed ^ (static_cast<std::uint64_t>(i) * 0x8DA6B343U) ^
                                 (static_cast<std::uint64_t>(j) * 0xD8163841U));
  return static_cast<double>(bits >> 11) * 0x1.0p-53 - 0.5;
}

double fade(double t) { return t * t * t * (t * (t * 6 - 15) + 10); }

double smooth_noise(std::uint64_t seed, double x, double y) {
  const double fx = std::floor(x), fy = std::floor(y);
  const auto i = static_cast<std::int64_t>(fx), j = static_cast<std::int64_t>(fy);
  const double a = fade(x - fx), b = fade(y - fy);
  const double top = (1 - a) * lattice(seed, i, j) + a * lattice(seed, i + 1, j);
  const double low = (1 - a) * lattice(seed, i, j + 1) + a * lattice(seed, i + 1, j + 1);
  return (1 - b) * top + b * low;
}

double gaussian(std::mt19937_64& generator) {
  const double u = (static_cast<double>(generator() >> 11) + 1) * 0x1.0p-53;
  const double v = static_cast<double>(generator() >> 11) * 0x1.0p-53;
  return std::sqrt(-2 * std::log(u)) * std::cos(2 * std::numbers::pi * v);
}

Eigen::Matrix3d ground_from_photo(const Station& station) {
  return (Eigen::AngleAxisd(station.omega_rad, Eigen::Vector3d::UnitX()) *
          Eigen::AngleAxisd(station.phi_rad, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(station.kappa_rad, Eigen::Vector3d::UnitZ()))
      .toRotationMatrix();
}

}  // namespace

Texture::Texture(std::uint64_t seed, double coarsest_m, double finest_m) : seed_(seed) {
  for (double size = coarsest_m; size > finest_m; size *= 0.53) sizes_m_.push_back(size);
}

double Texture::grey(double x_m, double y_m) const {
  double sum = 0;
  std::uint64_t octave = seed_ * 131;
  for (const double size : sizes_m_) {
    ++octave;
    // Octaves turned against each other, so that their lattices do not show.
    const double c = std::cos(static_cast<double>(octave)),
                 s = std::sin(static_cast<double>(octave));
    sum += smooth_noise(octave, (c * x_m - s * y_m) / size, (s * x_m + c * y_m) / size);
  }
  return 128 + 55 * sum;
}

Image expose(const GreyAt& grey, const Sensor& sensor) {
  cv::Mat values(sensor.height_px, sensor.width_px, CV_32F);
  for (int v = 0; v < sensor.height_px; ++v) {
    for (int u = 0; u < sensor.width_px; ++u) {
      double sum = 0;
      const int n = sensor.samples;
      for (int k = 0; k < n * n; ++k)
        sum += grey({u + (k % n + 0.5) / n - 0.5, v + (k / n + 0.5) / n - 0.5});
      values.at<float>(v, u) = static_cast<float>(sum / (n * n));
    }
  }
  if (sensor.blur_px > 0) cv::GaussianBlur(values, values, {0, 0}, sensor.blur_px);
  std::mt19937_64 generator(sensor.seed);
  Image image{sensor.width_px, sensor.height_px, 1, {}};
  for (int v = 0; v < sensor.height_px; ++v) {
    for (int u = 0; u < sensor.width_px; ++u) {
      const double value = values.at<float>(v, u) + sensor.noise_grey * gaussian(generator);
      image.data.push_back(static_cast<std::uint8_t>(std::clamp(value + 0.5, 0.0, 255.0)));
    }
  }
  return image;
}

Image through_jpeg(const Image& image, int quality) {
  return jpeg::decode_grey(jpeg::encode(image, quality), "a synthetic photo").value();
}

double Scene::height_m(double x_m, double y_m) const {
  return relief_m * (std::sin(0.4 * x_m + 0.3) * std::cos(0.35 * y_m) + 0.3 * std::sin(0.9 * y_m));
}

Eigen::Vector2d Scene::pixel_of(const Station& station, const Eigen::Vector3d& ground_m) const {
  const Eigen::Vector3d p = ground_from_photo(station).transpose() * (ground_m - station.centre_m);
  const Eigen::Vector2d ideal(p.x() / -p.z(), -p.y() / -p.z());
  const Eigen::Vector2d distorted = ideal * (1 + radial_k1 * ideal.squaredNorm());
  return Eigen::Vector2d((width_px - 1) / 2, (height_px - 1) / 2) + focal_px * distorted;
}

Eigen::Vector3d Scene::ground_of(const Station& station, const Eigen::Vector2d& pixel) const {
  const Eigen::Vector2d distorted =
      (pixel - Eigen::Vector2d((width_px - 1) / 2, (height_px - 1) / 2)) / focal_px;
  Eigen::Vector2d ideal = distorted;
  for (int i = 0; i < 8; ++i) ideal = distorted / (1 + radial_k1 * ideal.squaredNorm());
  const Eigen::Vector3d ray =
      ground_from_photo(station) * Eigen::Vector3d(ideal.x(), -ideal.y(), -1);
  Eigen::Vector3d ground = station.centre_m - ray * station.centre_m.z() / ray.z();
  for (int i = 0; i < 40; ++i) {
    const double z_m = height_m(ground.x(), ground.y());
    if (std::abs(z_m - ground.z()) < 1e-7) break;
    ground = station.centre_m + ray * (z_m - station.centre_m.z()) / ray.z();
  }
  return ground;
}

Image Scene::photo(const Station& station, Sensor sensor) const {
  sensor.width_px = static_cast<int>(width_px);
  sensor.height_px = static_cast<int>(height_px);
  // Rays at the corners of pixels; within one pixel the ground is as good as linear.
  const int across = sensor.width_px + 1;
  std::vector<Eigen::Vector2d> corner;
  for (int v = 0; v <= sensor.height_px; ++v) {
    for (int u = 0; u < across; ++u)
      corner.emplace_back(ground_of(station, Eigen::Vector2d(u - 0.5, v - 0.5)).head<2>());
  }
  const auto grey = [&](const Eigen::Vector2d& pixel) {
    const int u = static_cast<int>(pixel.x() + 0.5), v = static_cast<int>(pixel.y() + 0.5);
    const double a = pixel.x() + 0.5 - u, b = pixel.y() + 0.5 - v;
    const Eigen::Vector2d* top = &corner[static_cast<std::size_t>(v * across + u)];
    const Eigen::Vector2d* low = top + across;
    const Eigen::Vector2d ground =
        (1 - b) * ((1 - a) * top[0] + a * top[1]) + b * ((1 - a) * low[0] + a * low[1]);
    return texture.grey(ground.x(), ground.y());
  };
  return expose(grey, sensor);
}

}  // namespace plumbline::image::synthetic
