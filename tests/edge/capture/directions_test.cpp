// SPDX-License-Identifier: MIT
// Whole flights of decisions: a pilot who pauses, and photos on the way down.
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "tests/flights/capture_flight.h"

namespace plumbline::capture {
namespace {

flights::CaptureFlight climb(std::uint64_t seed) {
  flights::CaptureFlight flight;
  flight.seed = seed;
  flight.path.aside_m = 0;
  flight.receiver.fixed_sigma = {0.005, 0.010};
  flight.options.plan.aside_m.reset();
  return flight;
}

// Photos at heights, by entry of the plan: each once.
std::map<int, flights::CapturedPhoto> by_entry(const flights::CaptureLog& log) {
  std::map<int, flights::CapturedPhoto> photos;
  for (const auto& photo : log.photos) {
    if (photo.taken.target.reason != Reason::kHeight) continue;
    EXPECT_TRUE(photos.emplace(photo.taken.target.entry, photo).second)
        << "twice at " << photo.taken.target.height_m << " m";
  }
  return photos;
}

bool goes_down(const flights::CapturedPhoto& photo) {
  return photo.taken.place && photo.taken.place->velocity_m_s.z() < 0;
}

void expect_on_its_height(const flights::CapturedPhoto& photo) {
  // 4 m/s down and ten frames a second: half a period is 0.2 m, and the gusts of a look ahead.
  EXPECT_NEAR(photo.place_m.z(), photo.taken.target.height_m, 0.4);
}

TEST(CaptureFlight, PhotographsOnTheWayDownOnly) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto flight = climb(seed);
    flight.options.plan.direction = Direction::kDown;
    flight.options.plan.heights_m = {30, 40, 50, 60, 70, 80, 90};
    const auto photos = by_entry(fly(flight));
    EXPECT_EQ(photos.size(), 7u);
    for (const auto& [entry, photo] : photos) {
      EXPECT_TRUE(goes_down(photo)) << photo.taken.target.height_m;
      expect_on_its_height(photo);
    }
  }
}

TEST(CaptureFlight, PhotographsEachHeightUpAndDown) {
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto flight = climb(seed);
    flight.options.plan.direction = Direction::kBoth;
    flight.options.plan.heights_m = {30, 40, 50, 60, 70, 80, 88};
    const auto photos = by_entry(fly(flight));
    EXPECT_EQ(photos.size(), 14u);
    for (const auto& [entry, photo] : photos) {
      EXPECT_EQ(goes_down(photo), entry >= 7) << photo.taken.target.height_m;
      expect_on_its_height(photo);
    }
  }
}

// The climb takes some 30 s, with 0.15 pauses a second, of which a tenth falls within 0.5 m below a
// height: 18 in 40 flights. As they are rare and independent, three sigmas of that number are 13.
TEST(CaptureFlight, TakesAStillPhotoWhereThePilotPauses) {
  int still = 0;
  int quiet = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    auto flight = climb(seed);
    flight.path.pauses_per_s = 0.15;
    flight.path.gust_m_s = 0.03;
    flight.path.sideways_m_s = 0.03;
    const auto log = fly(flight);
    const auto photos = by_entry(log);
    EXPECT_EQ(photos.size(), 13u);
    for (const auto& [entry, photo] : photos) {
      if (!photo.taken.marks.still) continue;
      ++still;
      // 0.15 m/s at the last fix, which is 0.3 s old at most; then it may have begun to move on.
      EXPECT_LT(photo.taken.place->velocity_m_s.norm(), 0.15 + 2 * 0.3);
      quiet += photo.taken.place->velocity_m_s.norm() < 0.15 ? 1 : 0;
      EXPECT_NEAR(photo.place_m.z(), photo.taken.target.height_m, 0.6);
    }
  }
  EXPECT_NEAR(still, 18, 13);
  EXPECT_GE(quiet, still - still / 4);
}

}  // namespace
}  // namespace plumbline::capture
