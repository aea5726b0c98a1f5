// SPDX-License-Identifier: MIT
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>

#include "tests/firmware/ingest/temporary_folder.h"
#include "tests/soak/flown_day.h"

namespace plumbline::soak {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

// A part of it under sanitizers, which look for leaks by themselves.
constexpr int kHours = PLUMBLINE_SANITIZED ? 3 : 24;

// Windows of the clock fit and the predictor roll on, as the size of a sentence does. A leak of
// one block a flight is more than that.
constexpr std::int64_t kRollingBlocks = 12;
constexpr std::int64_t kRollingBytes = 16 * 1024;
static_assert(kFlightsAnHour > kRollingBlocks);

class ServiceSoak : public testing::Test {
 protected:
  static void expect_all_photographed(const FlownHour& hour) {
    ASSERT_EQ(hour.flights.size(), static_cast<std::size_t>(kFlightsAnHour));
    int photos = 0;
    for (Flown flown : hour.flights) {
      std::ranges::sort(flown.heights_m);
      EXPECT_THAT(flown.heights_m, ElementsAre(30, 35, 40, 45)) << flown.folder;
      EXPECT_GE(flown.aside, 1) << flown.folder;
      photos += static_cast<int>(flown.heights_m.size()) + flown.aside;
    }
    EXPECT_EQ(hour.stored, photos);
    EXPECT_EQ(hour.folders, static_cast<std::size_t>(kFlightsAnHour) + 1);
  }
  static void expect_the_same(const FlownHour& now, const FlownHour& usual) {
    EXPECT_NEAR(static_cast<double>(now.disk_bytes), static_cast<double>(usual.disk_bytes),
                0.02 * static_cast<double>(usual.disk_bytes));
    EXPECT_LE(std::abs(now.in_use.blocks - usual.in_use.blocks), kRollingBlocks);
    EXPECT_LE(std::abs(now.in_use.bytes - usual.in_use.bytes), kRollingBytes);
    EXPECT_EQ(now.in_use.descriptors, usual.in_use.descriptors);
  }

  ingest::TemporaryFolder folder_;
};

TEST_F(ServiceSoak, ADayOfFlightsLosesNothingAndEndsWithWhatItBeganWith) {
  FlownDay day(kHours, folder_.path().string());
  std::vector<FlownHour> after;  // their flights left out, for they hold memory
  after.reserve(kHours);
  const Status lived = day.live([&](int hour, const FlownHour& flown) {
    SCOPED_TRACE("hour " + std::to_string(hour + 1));
    expect_all_photographed(flown);
    after.push_back({{}, 0, flown.disk_bytes, 0, flown.in_use});
  });
  ASSERT_TRUE(lived) << lived.error().sentence;
  EXPECT_THAT(day.hangs(), IsEmpty());
  for (std::size_t hour = 2; hour < after.size(); ++hour) {
    SCOPED_TRACE("hour " + std::to_string(hour + 1));
    expect_the_same(after[hour], after[1]);
  }
}

}  // namespace
}  // namespace plumbline::soak
