// SPDX-License-Identifier: MIT
#include "sim/terrain.h"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/random.h"

namespace plumbline::sim {
namespace {

TerrainOptions small_options() {
  TerrainOptions options;
  options.half_extent_m = 40;
  options.spread = 0.8;
  options.seed = 3;
  return options;
}

// Rays that cut a corner of a box by less than 3 cm may miss it; no more than these.
constexpr double kShareThatMayCutCorners = 0.004;

// Follows the ray down in steps of half a millimetre.
double met_step_by_step(const Terrain& terrain, const Terrain::Ray& ray) {
  for (double z = terrain.highest_m() + 0.01;; z -= 5e-4) {
    const double ground_m = terrain.height_m(ray.east_at_zero_m + z * ray.east_per_metre,
                                             ray.north_at_zero_m + z * ray.north_per_metre);
    if (ground_m >= z) return z;
  }
}

TEST(Terrain, MeetsRaysWhereTheyFirstTouchTheGround) {
  Terrain terrain(small_options());
  terrain.finish();
  Random random(5, 1);
  int off = 0;
  for (int k = 0; k < 3000; ++k) {
    const Terrain::Ray ray{random.uniform(-25, 25), random.uniform(-25, 25), random.uniform(-1, 1),
                           random.uniform(-1, 1)};
    const double met_m = terrain.meet(ray, random.uniform(-1, 1));
    if (std::abs(met_m - met_step_by_step(terrain, ray)) > 7e-4) ++off;
  }
  EXPECT_LE(off, 3000 * kShareThatMayCutCorners);
}

TEST(Terrain, MeetsTheSidesOfABoxFromBothSides) {
  Terrain terrain(small_options());
  terrain.finish();
  const Box& box = terrain.features().boxes.front();
  const double top_m = terrain.height_m(box.centre_m.x(), box.centre_m.y());
  int off = 0, rays = 0;
  for (const double lean : {-0.8, 0.8}) {
    for (double aside_m = -5; aside_m <= 5; aside_m += 0.02, ++rays) {
      const Terrain::Ray ray{box.centre_m.x() + aside_m - lean * top_m, box.centre_m.y(), lean, 0};
      if (std::abs(terrain.meet(ray, 0) - met_step_by_step(terrain, ray)) > 7e-4) ++off;
    }
  }
  EXPECT_LE(off, rays * kShareThatMayCutCorners);
}

TEST(Terrain, LiesAtHeightZeroAtTheFoot) {
  EXPECT_NEAR(Terrain(small_options()).height_m(0, 0), 0, 1e-6);
}

TEST(Terrain, HasReliefOfSomeMetresAndNoneWhereNoneIsWanted) {
  TerrainOptions options = small_options();
  Terrain hilly(options);
  hilly.finish();
  EXPECT_GT(hilly.highest_m(), 1.5);
  EXPECT_LT(hilly.highest_m(), 8);
  options.relief = 0;
  const Terrain plain(options);
  EXPECT_EQ(plain.height_m(3.3, -7.1), 0);
}

TEST(Terrain, IsAPlaneExactlyUnderAPressedPlate) {
  Terrain terrain(small_options());
  const Eigen::Vector2d centre_m(4.321, -6.789);
  const Eigen::Vector2d slope(0.11, -0.07);
  const double centre_height_m = terrain.height_m(centre_m.x(), centre_m.y());
  terrain.press_plate(centre_m, slope, 0.5);
  for (double bearing = 0; bearing < 6.28; bearing += 0.1) {
    const Eigen::Vector2d across_m = 0.5 * Eigen::Vector2d(std::sin(bearing), std::cos(bearing));
    const Eigen::Vector2d place_m = centre_m + across_m;
    EXPECT_NEAR(terrain.height_m(place_m.x(), place_m.y()), centre_height_m + slope.dot(across_m),
                1e-6);
  }
}

}  // namespace
}  // namespace plumbline::sim
