// SPDX-License-Identifier: MIT
#include "edge/gnss/event_match.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace plumbline::gnss {
namespace {

using std::chrono::hours;
using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::seconds;
using Times = std::vector<UtcTime>;

const std::vector<double> kFlight_s = {0, 4.1, 7.9, 13.2, 17.0, 24.5, 28.1, 33.3};

Times times(const std::vector<double>& at_s, double shift_s) {
  Times result;
  for (const double t : at_s) {
    result.emplace_back(microseconds(std::llround((t + shift_s + 1e9) * 1e6)));
  }
  return result;
}

std::vector<double> without(std::vector<double> values, std::size_t index) {
  values.erase(values.begin() + static_cast<std::ptrdiff_t>(index));
  return values;
}

TEST(EventMatch, PairsEqualCountsWhateverTheClocksSay) {
  const auto match = match_events(times(kFlight_s, 0), times(kFlight_s, -32400.37), {});
  ASSERT_TRUE(match);
  for (std::size_t i = 0; i < kFlight_s.size(); ++i) EXPECT_EQ(match->event_of_photo[i], i);
  EXPECT_EQ(match->offset, milliseconds(-32400370));
}

TEST(EventMatch, ForgivesTheJitterOfACamerasStamps) {
  std::mt19937_64 random(1);
  std::uniform_real_distribution<double> jitter(0, 0.15);
  std::vector<double> photos = kFlight_s;
  for (double& t : photos) t += jitter(random);
  EXPECT_TRUE(match_events(times(photos, 0), times(kFlight_s, 5), {}));
}

TEST(EventMatch, RefusesEqualCountsWhoseIntervalsDisagree) {
  std::vector<double> photos = kFlight_s;
  photos[3] += 0.5;
  const auto match = match_events(times(photos, 0), times(kFlight_s, 0), {});
  ASSERT_FALSE(match);
  EXPECT_NE(match.error().sentence.find("do not agree"), std::string::npos);
}

TEST(EventMatch, FindsThePhotosAmongMoreMarks) {
  for (std::size_t missing = 0; missing < kFlight_s.size(); ++missing) {
    const auto match =
        match_events(times(without(kFlight_s, missing), 0), times(kFlight_s, 77), {});
    ASSERT_TRUE(match) << missing;
    for (std::size_t i = 0; i + 1 < kFlight_s.size(); ++i) {
      EXPECT_EQ(match->event_of_photo[i], i < missing ? i : i + 1) << missing;
    }
  }
}

TEST(EventMatch, LeavesAPhotoWithoutItsLostMarkEmpty) {
  for (std::size_t missing = 0; missing < kFlight_s.size(); ++missing) {
    const auto match =
        match_events(times(kFlight_s, 0), times(without(kFlight_s, missing), 77), {});
    ASSERT_TRUE(match) << missing;
    for (std::size_t i = 0; i < kFlight_s.size(); ++i) {
      const auto expected =
          i == missing ? std::nullopt : std::optional<std::size_t>(i < missing ? i : i - 1);
      EXPECT_EQ(match->event_of_photo[i], expected) << missing;
    }
  }
}

TEST(EventMatch, RefusesRegularIntervalsOfUnequalCount) {
  const auto match = match_events(times({0, 5, 10, 15}, 0), times({0, 5, 10, 15, 20}, 3), {});
  ASSERT_FALSE(match);
  EXPECT_NE(match.error().sentence.find("several ways"), std::string::npos);
  EXPECT_NE(match.error().sentence.find("--time-offset"), std::string::npos);
}

TEST(EventMatch, LetsAKnownOffsetDecideBetweenSeveralFits) {
  MatchOptions options;
  options.known_offset = {seconds(5), seconds(1)};
  const auto match = match_events(times({0, 5, 10, 15}, 0), times({0, 5, 10, 15, 20}, 0), options);
  ASSERT_TRUE(match);
  EXPECT_EQ(match->event_of_photo[0], 1u);
}

TEST(EventMatch, RefusesAFitThatContradictsTheKnownOffset) {
  MatchOptions options;
  options.known_offset = {seconds(0), seconds(1)};
  EXPECT_FALSE(match_events(times(kFlight_s, 0), times(kFlight_s, 60), options));
}

TEST(EventMatch, RefusesTwoPhotosAmongMoreMarks) {
  EXPECT_FALSE(match_events(times({0, 4.1}, 0), times(kFlight_s, 0), {}));
}

TEST(EventMatch, RefusesAPhotoThatCouldHaveEitherOfTwoMarks) {
  std::vector<double> marks = kFlight_s;
  marks.insert(marks.begin() + 3, 13.05);
  EXPECT_FALSE(match_events(times(kFlight_s, 0), times(marks, 0), {}));
}

TEST(EventMatch, LeavesOutDoubleMarksOfABouncingContact) {
  std::vector<double> marks = kFlight_s;
  marks.insert(marks.begin() + 4, 13.203);
  const auto match = match_events(times(kFlight_s, 0), times(marks, 9), {});
  ASSERT_TRUE(match);
  EXPECT_EQ(match->bounced, 1u);
  EXPECT_EQ(match->event_of_photo[3], 3u);
  EXPECT_EQ(match->event_of_photo[4], 5u);
}

TEST(EventMatch, RefusesNothing) {
  EXPECT_FALSE(match_events({}, times(kFlight_s, 0), {}));
  EXPECT_FALSE(match_events(times(kFlight_s, 0), {}, {}));
}

}  // namespace
}  // namespace plumbline::gnss
