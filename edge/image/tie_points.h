// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "edge/base/image.h"
#include "edge/base/progress.h"
#include "edge/base/result.h"

namespace plumbline::image {

struct TieOptions {
  int ties_wanted = 2000;
  int threads = 1;
  std::uint64_t seed = 1;
};

// One point of the ground measured in one photo.
struct TieObservation {
  int photo = 0;
  int point = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  // Of `pixel`, from the least-squares match (Gruen 1985); good up to one factor common to all
  // ties, which the adjustment estimates.
  Eigen::Matrix2d covariance_px2 = Eigen::Matrix2d::Identity();
};

// What is known of the match of two photos: pixel_second ~ homography * pixel_first.
struct PhotoPair {
  int first = 0;
  int second = 0;
  Eigen::Matrix3d second_from_first = Eigen::Matrix3d::Identity();
  int inliers = 0;
};

struct TiePoints {
  int point_count = 0;
  std::vector<TieObservation> observations;  // sorted by point, then photo
  std::vector<PhotoPair> pairs;              // those found to overlap
  std::vector<int> component;  // per photo: photos tied together share a number; -1 = tied to none
};

// Finds the same ground points in photos of one scene, taken from different heights (scale ratios
// up to 3), turned by any angle about the vertical, and slightly tilted. `photo_count` photos of
// equal size. Measures to a few hundredths to tenths of a pixel. Fails where a photo cannot be
// loaded. Photos that overlap no other are reported by `component`, not as an error.
Result<TiePoints> find_tie_points(const GreyImageSource& photos, int photo_count,
                                  const TieOptions& options, const Progress& progress);

// The same for a series of photos that grows while it is measured: what was loaded and compared
// before is not again. The points are those of find_tie_points() on all photos at once.
class TieFinder {
 public:
  TieFinder();
  ~TieFinder();
  TieFinder(TieFinder&&) noexcept;
  TieFinder& operator=(TieFinder&&) noexcept;

  // `photos` are those of the calls before, with the same options, and as many more as there are.
  // After a failure it may be called again.
  Result<TiePoints> find(const GreyImageSource& photos, int photo_count, const TieOptions& options,
                         const Progress& progress);

 private:
  struct Known;
  std::unique_ptr<Known> known_;
};

// A point measured by hand in one photo, to be found in the others.
struct Pick {
  int photo = 0;
  int point = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

// Finds each pick in the other photos that see it (guided by `ties`), by least-squares matching of
// its surroundings. Returns observations of the OTHER photos only; a point that cannot be found
// with confidence in a photo is left out there.
Result<std::vector<TieObservation>> transfer_picks(const GreyImageSource& photos, int photo_count,
                                                   const std::vector<Pick>& picks,
                                                   const TiePoints& ties,
                                                   const TieOptions& options);

}  // namespace plumbline::image
