// SPDX-License-Identifier: MIT
#include "edge/image/tie_points.h"

#include <gtest/gtest.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <mutex>
#include <set>

#include "edge/base/parallel.h"
#include "synthetic.h"

namespace plumbline::image {
namespace {

using synthetic::Scene;
using synthetic::Sensor;
using synthetic::Station;

// A climb from 20 to 36 m with drift, turns and tilts, over hills of 1.5 m.
const std::vector<Station>& climb() {
  static const std::vector<Station> stations = {{{0.0, 0.0, 20}, 0.010, -0.020, 0.1},
                                                {{0.6, -0.4, 23}, -0.020, 0.010, 0.9},
                                                {{0.9, 0.5, 27}, 0.030, 0.015, -0.4},
                                                {{-0.5, 0.8, 31}, 0.000, -0.030, 2.2},
                                                {{2.8, 0.2, 36}, -0.015, 0.020, 0.3}};
  return stations;
}

const std::vector<Image>& climb_photos() {
  static const std::vector<Image> photos = [] {
    std::vector<Image> made(climb().size());
    parallel_for(static_cast<int>(made.size()), 2, [&](int i) {
      const auto slot = static_cast<std::size_t>(i);
      Sensor sensor;
      sensor.seed = 100 + slot;
      made[slot] = synthetic::through_jpeg(Scene().photo(climb()[slot], sensor), 92);
    });
    return made;
  }();
  return photos;
}

GreyImageSource source_of(const std::vector<Image>& photos) {
  return [&photos](int i) -> Result<Image> { return photos[static_cast<std::size_t>(i)]; };
}

TiePoints find_ties(const std::vector<Image>& photos, TieOptions options = {600, 2, 1}) {
  const auto ties =
      find_tie_points(source_of(photos), static_cast<int>(photos.size()), options, {});
  EXPECT_TRUE(ties.ok()) << (ties.ok() ? "" : ties.error().sentence);
  return ties.ok() ? *ties : TiePoints{};
}

const TiePoints& climb_ties() {
  static const TiePoints ties = find_ties(climb_photos());
  return ties;
}

std::map<int, std::vector<TieObservation>> by_point(const TiePoints& ties) {
  std::map<int, std::vector<TieObservation>> points;
  for (const TieObservation& one : ties.observations) points[one.point].push_back(one);
  return points;
}

Image blank(int grey) {
  return {800, 600, 1, std::vector<std::uint8_t>(800 * 600, static_cast<std::uint8_t>(grey))};
}

TEST(FindTiePoints, TiesAllPhotosOfAClimbWithManyPointsInThreeAndMore) {
  int in_three = 0;
  for (const auto& [point, rays] : by_point(climb_ties())) in_three += rays.size() >= 3 ? 1 : 0;
  EXPECT_EQ(climb_ties().component, std::vector<int>({0, 0, 0, 0, 0}));
  EXPECT_GE(climb_ties().point_count, 300);
  EXPECT_LE(climb_ties().point_count, 600);
  EXPECT_GE(in_three, 200);
}

// Each pair of observations of a point, against where the scene puts the first one's ground.
TEST(FindTiePoints, MeasuresReliefToATenthOfAPixelWithFewOutliers) {
  const Scene scene;
  double squares = 0, normalised = 0;
  int good = 0, bad = 0;
  for (const auto& [point, rays] : by_point(climb_ties())) {
    const TieObservation& first = rays.front();
    const auto& from = climb()[static_cast<std::size_t>(first.photo)];
    for (std::size_t k = 1; k < rays.size(); ++k) {
      const auto& to = climb()[static_cast<std::size_t>(rays[k].photo)];
      const Eigen::Vector2d truth = scene.pixel_of(to, scene.ground_of(from, first.pixel));
      const double magnified = from.centre_m.z() / to.centre_m.z();
      const Eigen::Vector2d error = rays[k].pixel - truth;
      const Eigen::Matrix2d covariance =
          rays[k].covariance_px2 + magnified * magnified * first.covariance_px2;
      if (error.norm() > 1.0) {
        ++bad;
        continue;
      }
      ++good;
      squares += error.squaredNorm() / 2;
      normalised += error.dot(covariance.inverse() * error) / 2;
    }
  }
  const double rms_px = std::sqrt(squares / good);
  printf("rms %.3f px per axis, error/sigma %.2f, %d of %d beyond a pixel\n", rms_px,
         std::sqrt(normalised / good), bad, good + bad);
  EXPECT_LT(rms_px, 0.1);
  EXPECT_LT(bad, 1 + (good + bad) / 100);
  EXPECT_GT(std::sqrt(normalised / good), 0.5);
  EXPECT_LT(std::sqrt(normalised / good), 2.0);
}

TEST(FindTiePoints, ListsNoCornerTwiceAndSortsByPointThenPhoto) {
  const auto& observations = climb_ties().observations;
  for (std::size_t i = 1; i < observations.size(); ++i) {
    const auto& a = observations[i - 1];
    const auto& b = observations[i];
    EXPECT_LT(std::pair(a.point, a.photo), std::pair(b.point, b.photo));
  }
  std::map<int, std::vector<Eigen::Vector2d>> places;
  int crowded = 0;
  for (const TieObservation& one : climb_ties().observations) {
    for (const Eigen::Vector2d& other : places[one.photo])
      crowded += (other - one.pixel).norm() < 2.0 ? 1 : 0;
    places[one.photo].push_back(one.pixel);
  }
  EXPECT_LE(crowded, static_cast<int>(climb_ties().observations.size()) / 100);
}

TEST(FindTiePoints, GivesTheSameBitsForOneAndTwoThreads) {
  const std::vector<Image> photos(climb_photos().begin(), climb_photos().begin() + 3);
  const TiePoints one = find_ties(photos, {300, 1, 1});
  const TiePoints two = find_ties(photos, {300, 2, 1});
  ASSERT_EQ(one.observations.size(), two.observations.size());
  ASSERT_GT(one.observations.size(), 100U);
  for (std::size_t i = 0; i < one.observations.size(); ++i) {
    EXPECT_EQ(one.observations[i].pixel, two.observations[i].pixel);
    EXPECT_EQ(one.observations[i].covariance_px2, two.observations[i].covariance_px2);
  }
}

TEST(FindTiePoints, TiesPhotosOfThreefoldScale) {
  const Scene scene;
  Sensor sensor;
  const std::vector<Station> stations = {{{0, 0, 15}, 0, 0.02, 0}, {{0.5, 0.5, 43}, 0.01, 0, 1.2}};
  std::vector<Image> photos;
  for (const Station& station : stations) {
    ++sensor.seed;
    photos.push_back(scene.photo(station, sensor));
  }
  const TiePoints ties = find_ties(photos);
  EXPECT_EQ(ties.component, std::vector<int>({0, 0}));
  EXPECT_GE(ties.point_count, 30);
  int bad = 0;
  for (const auto& [point, rays] : by_point(ties)) {
    const Eigen::Vector3d ground = scene.ground_of(stations[0], rays[0].pixel);
    bad += (scene.pixel_of(stations[1], ground) - rays[1].pixel).norm() > 0.5 ? 1 : 0;
  }
  EXPECT_LE(bad, ties.point_count / 50);
}

TEST(FindTiePoints, LeavesAloneWhatDoesNotOverlapAndWhatHasNoTexture) {
  std::vector<Image> photos(climb_photos().begin(), climb_photos().begin() + 2);
  Sensor sensor;
  sensor.seed = 9;
  photos.push_back(Scene().photo({{400, 300, 22}, 0, 0, 0}, sensor));
  photos.push_back(blank(0));
  photos.push_back(blank(130));
  EXPECT_EQ(find_ties(photos).component, std::vector<int>({0, 0, -1, -1, -1}));
}

TEST(FindTiePoints, TiesTwoPhotosOfOnePlace) {
  const std::vector<Image> photos = {climb_photos()[0], climb_photos()[0]};
  const TiePoints ties = find_ties(photos);
  EXPECT_EQ(ties.component, std::vector<int>({0, 0}));
  for (const auto& [point, rays] : by_point(ties))
    EXPECT_LT((rays[0].pixel - rays[1].pixel).norm(), 0.02);
}

TEST(FindTiePoints, SurvivesPhotosOfNoSizeOrHardlyAny) {
  for (const Image& tiny :
       {Image{}, Image{1, 1, 1, {7}}, Image{12, 9, 1, std::vector<std::uint8_t>(108, 50)}}) {
    const TiePoints ties = find_ties({tiny, tiny});
    EXPECT_EQ(ties.component, std::vector<int>({-1, -1}));
  }
  EXPECT_EQ(find_ties({}).point_count, 0);
  EXPECT_EQ(find_ties({blank(90)}).component, std::vector<int>({-1}));
}

TEST(FindTiePoints, HandsOnTheSentenceOfAPhotoThatCannotBeLoaded) {
  const GreyImageSource broken = [](int i) -> Result<Image> {
    if (i == 1) return Error{"photo 0002.jpg is cut short; copy it again."};
    return blank(100);
  };
  const auto ties = find_tie_points(broken, 3, {}, {});
  ASSERT_FALSE(ties.ok());
  EXPECT_EQ(ties.error().sentence, "photo 0002.jpg is cut short; copy it again.");
}

void expect_same_bits(const TiePoints& a, const TiePoints& b) {
  EXPECT_EQ(a.point_count, b.point_count);
  EXPECT_EQ(a.component, b.component);
  ASSERT_EQ(a.observations.size(), b.observations.size());
  for (std::size_t k = 0; k < a.observations.size(); ++k) {
    EXPECT_EQ(a.observations[k].photo, b.observations[k].photo);
    EXPECT_EQ(a.observations[k].point, b.observations[k].point);
    EXPECT_EQ(a.observations[k].pixel, b.observations[k].pixel);
    EXPECT_EQ(a.observations[k].covariance_px2, b.observations[k].covariance_px2);
  }
}

TEST(TieFinder, FindsInASeriesThatGrowsWhatIsFoundInAllAtOnce) {
  TieFinder finder;
  std::vector<int> loads(climb_photos().size());
  const GreyImageSource counted = [&](int i) -> Result<Image> {
    ++loads[static_cast<std::size_t>(i)];
    return climb_photos()[static_cast<std::size_t>(i)];
  };
  for (const int photos : {2, 3, 5, 5}) {
    const auto ties = finder.find(counted, photos, {600, 1, 1}, {});
    ASSERT_TRUE(ties.ok());
    if (photos == 5) expect_same_bits(*ties, climb_ties());
  }
  EXPECT_EQ(loads, std::vector<int>({1, 1, 1, 1, 1}));
}

TEST(TieFinder, GoesOnAfterAPhotoThatCouldNotBeLoaded) {
  TieFinder finder;
  bool broken = true;
  const GreyImageSource source = [&](int i) -> Result<Image> {
    if (broken && i == 4) return Error{"photo 5 is being written."};
    return climb_photos()[static_cast<std::size_t>(i)];
  };
  EXPECT_FALSE(finder.find(source, 5, {600, 1, 1}, {}).ok());
  broken = false;
  const auto ties = finder.find(source, 5, {600, 1, 1}, {});
  ASSERT_TRUE(ties.ok());
  expect_same_bits(*ties, climb_ties());
}

TEST(TransferPicks, FindsAPickInEveryPhotoThatSeesIt) {
  const Scene scene;
  std::vector<Pick> picks;
  for (int k = 0; k < 25; ++k) {
    picks.push_back({2, 1000 + k, {200.3 + 100.17 * (k % 5), 150.6 + 75.13 * (k / 5)}});
  }
  const auto found = transfer_picks(source_of(climb_photos()), 5, picks, climb_ties(), {600, 2, 1});
  ASSERT_TRUE(found.ok());
  double squares = 0;
  int wrong = 0;
  for (const TieObservation& one : *found) {
    ASSERT_NE(one.photo, 2);
    const Pick& pick = picks[static_cast<std::size_t>(one.point - 1000)];
    const Eigen::Vector2d error =
        one.pixel - scene.pixel_of(climb()[static_cast<std::size_t>(one.photo)],
                                   scene.ground_of(climb()[2], pick.pixel));
    wrong += error.norm() > 0.5 ? 1 : 0;
    squares += std::min(error.squaredNorm(), 0.25) / 2;
  }
  printf("picks: %zu transfers, rms %.3f px, %d wrong\n", found->size(),
         std::sqrt(squares / static_cast<double>(found->size())), wrong);
  EXPECT_GE(found->size(), 60U);
  EXPECT_EQ(wrong, 0);
  EXPECT_LT(std::sqrt(squares / static_cast<double>(found->size())), 0.1);
}

TEST(TransferPicks, ReturnsNoPhotoPickedAlreadyAndNoPickOutsideItsPhoto) {
  const std::vector<Pick> picks = {{2, 5, {400.2, 300.7}},    {3, 5, {401.0, 299.0}},
                                   {2, 6, {-50, 20}},         {2, 7, {1e9, -1e9}},
                                   {2, 8, {std::nan(""), 5}}, {2, 9, {799.4, 0.2}}};
  const auto found = transfer_picks(source_of(climb_photos()), 5, picks, climb_ties(), {600, 2, 1});
  ASSERT_TRUE(found.ok());
  std::set<int> photos;
  for (const TieObservation& one : *found) {
    EXPECT_TRUE(one.photo != 2 && one.photo != 3);
    EXPECT_EQ(one.point, 5);
    EXPECT_TRUE(photos.insert(one.photo).second);
  }
}

TEST(TransferPicks, LeavesOutAPointOfRepeatingTexture) {
  // A board of equal squares, smaller than any prediction is sure of, on the ground of both photos.
  const auto board = [](double shift_px, std::uint64_t seed) {
    const synthetic::Texture texture(3, 60, 0.5);
    Sensor sensor;
    sensor.seed = seed;
    return synthetic::expose(
        [&](const Eigen::Vector2d& pixel) {
          const Eigen::Vector2d x = pixel + Eigen::Vector2d(shift_px, 0);
          const bool on_board = std::abs(x.x() - 400) < 150 && std::abs(x.y() - 300) < 150;
          if (!on_board) return texture.grey(x.x(), x.y());
          const bool dark = (static_cast<int>(x.x() / 3) + static_cast<int>(x.y() / 3)) % 2 == 0;
          return dark ? 60.0 : 190.0;
        },
        sensor);
  };
  const std::vector<Image> photos = {board(0, 1), board(9.4, 2)};
  const TiePoints ties = find_ties(photos);
  ASSERT_EQ(ties.component, std::vector<int>({0, 0}));
  const auto found = transfer_picks(source_of(photos), 2, {{0, 1, {402, 300}}}, ties, {600, 2, 1});
  ASSERT_TRUE(found.ok());
  EXPECT_TRUE(found->empty());
}

}  // namespace
}  // namespace plumbline::image
