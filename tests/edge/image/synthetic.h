// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <optional>
#include <vector>

#include "edge/base/image.h"

// Photos whose geometry is known exactly: a texture given by a formula, seen by ideal cameras.
namespace plumbline::image::synthetic {

// Grey values of the ground: smooth noise of every size from `coarsest_m` down to below `finest_m`,
// each with the same contrast, as on bare ground and grass.
class Texture {
 public:
  Texture(std::uint64_t seed, double coarsest_m, double finest_m);
  double grey(double x_m, double y_m) const;  // about 0..255, mean 128

 private:
  std::uint64_t seed_;
  std::vector<double> sizes_m_;
};

// Grey of a place in the photo; places between pixels are asked for.
using GreyAt = std::function<double(const Eigen::Vector2d& pixel)>;

struct Sensor {
  int width_px = 800;
  int height_px = 600;
  double blur_px = 0.5;    // Gaussian, added to the square pixel
  double noise_grey = 2;   // one standard deviation
  std::uint64_t seed = 1;  // of the noise
  int samples = 2;         // across a pixel
};

// Square pixels by supersampling, then blur, noise and rounding to 8 bits.
Image expose(const GreyAt& grey, const Sensor& sensor);

// Out and back through a JPEG file.
Image through_jpeg(const Image& image, int quality);

// A downward camera over ground with relief.
struct Station {
  Eigen::Vector3d centre_m = Eigen::Vector3d::Zero();
  double omega_rad = 0;
  double phi_rad = 0;
  double kappa_rad = 0;
};

struct Scene {
  Texture texture{1, 8.0, 0.03};
  double relief_m = 1.5;  // amplitude of hills some 15 m across
  double focal_px = 800;
  double radial_k1 = -0.02;
  double width_px = 800;
  double height_px = 600;

  double height_m(double x_m, double y_m) const;
  Eigen::Vector2d pixel_of(const Station& station, const Eigen::Vector3d& ground_m) const;
  // Where the ray of a pixel meets the ground.
  Eigen::Vector3d ground_of(const Station& station, const Eigen::Vector2d& pixel) const;
  Image photo(const Station& station, Sensor sensor) const;
};

}  // namespace plumbline::image::synthetic
