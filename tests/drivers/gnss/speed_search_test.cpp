// SPDX-License-Identifier: MIT
#include "drivers/gnss/speed_search.h"

#include <gtest/gtest.h>

namespace plumbline::gnss_driver {
namespace {

using std::chrono::milliseconds;

// A line at one speed: bytes are sentences there, and noise at every other.
struct Line {
  int baud;
  int bytes_per_burst;
  milliseconds between;
};

// How long the search takes to come to the line's speed and stay with it.
milliseconds search(const Line& line, const std::vector<int>& speeds) {
  SpeedSearch search(speeds);
  int speed = speeds.front();
  milliseconds time{0};
  milliseconds found{0};
  search.begin(HostTime(time));
  for (int burst = 0; burst < 200; ++burst) {
    time += line.between;
    search.bytes_came(static_cast<std::size_t>(line.bytes_per_burst));
    if (speed == line.baud) search.sentence_came(HostTime(time));
    if (const auto next = search.next(HostTime(time))) {
      speed = *next;
      found = time;
    }
  }
  EXPECT_EQ(speed, line.baud);
  return found;
}

const std::vector<int> kSpeeds = {115200, 38400, 9600, 57600, 230400, 460800, 921600, 19200, 4800};

TEST(SpeedSearch, FindsEverySpeedFastAndSlowReceiversAlike) {
  for (const int baud : kSpeeds) {
    EXPECT_LE(search({baud, 250, milliseconds(200)}, kSpeeds), milliseconds(8 * 600));
    EXPECT_LE(search({baud, 80, milliseconds(1000)}, kSpeeds), milliseconds(8 * 2000));
  }
}

TEST(SpeedSearch, StaysWhereSentencesComeThoughNoiseComesWithThem) {
  SpeedSearch search(kSpeeds);
  search.begin(HostTime(milliseconds(0)));
  for (int second = 1; second < 100; ++second) {
    search.bytes_came(5000);
    if (second % 2 == 1) search.sentence_came(HostTime(milliseconds(1000 * second)));
    EXPECT_FALSE(search.next(HostTime(milliseconds(1000 * second))));
  }
}

TEST(SpeedSearch, TriesNothingWhereNothingComesOrThereIsNoChoice) {
  SpeedSearch silent(kSpeeds);
  silent.begin(HostTime(milliseconds(0)));
  EXPECT_FALSE(silent.next(HostTime(std::chrono::hours(1))));
  SpeedSearch fixed({38400});
  fixed.begin(HostTime(milliseconds(0)));
  fixed.bytes_came(100000);
  EXPECT_FALSE(fixed.next(HostTime(std::chrono::hours(1))));
}

}  // namespace
}  // namespace plumbline::gnss_driver
