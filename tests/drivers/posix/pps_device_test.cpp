// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <vector>

#include "drivers/event_queue.h"
#include "drivers/posix/pps_line.h"
#include "drivers/posix/system_clock.h"

namespace plumbline::posix {
namespace {

using namespace std::chrono_literals;

// A PPS device that pulses by itself (pps-ktimer, pps-gpio), named by PLUMBLINE_TEST_PPS.
class PulsingDevice : public ::testing::Test {
 protected:
  void SetUp() override {
    const char* path = std::getenv("PLUMBLINE_TEST_PPS");
    if (path == nullptr) GTEST_SKIP() << "no PPS device to try: PLUMBLINE_TEST_PPS is not set";
    name_ = std::filesystem::path(path).filename();
    line_ = open_pps_line(path, clock_);
    ASSERT_TRUE(line_.ok()) << line_.error().sentence;
    ASSERT_TRUE((*line_)->listen([&](LineEvent event) { events_.push(event); }).ok());
  }
  void TearDown() override {
    if (line_.ok()) (*line_)->stop();
  }

  // The next pulse, or none within 10 s.
  std::optional<LineEdge> next() {
    std::optional<LineEvent> event = events_.pop();
    while (!event && clock_.wait(signal_, clock_.now() + 10s)) event = events_.pop();
    const LineEdge* edge = event ? std::get_if<LineEdge>(&*event) : nullptr;
    return edge == nullptr ? std::nullopt : std::optional(*edge);
  }

  // The last stamp as the kernel shows it to people: "SECONDS.NANOSECONDS#COUNT".
  WallTime shown() const {
    std::ifstream file("/sys/class/pps/" + name_ + "/assert");
    std::int64_t seconds = 0, nanoseconds = 0;
    char point = 0;
    file >> seconds >> point >> nanoseconds;
    return WallTime(std::chrono::seconds(seconds) + std::chrono::nanoseconds(nanoseconds));
  }

  SystemClock clock_;
  Signal signal_;
  EventQueue<LineEvent> events_{signal_};
  std::string name_;
  Result<std::unique_ptr<TriggerLine>> line_ = Error{"not opened"};
};

TEST_F(PulsingDevice, GivesAPulseASecond) {
  std::vector<LineEdge> edges;
  for (int i = 0; i < 4; ++i) {
    const auto edge = next();
    ASSERT_TRUE(edge);
    edges.push_back(*edge);
  }
  EXPECT_EQ(edges[3].sequence, 3u);
  EXPECT_NEAR(std::chrono::duration<double>(edges[3].time - edges[0].time).count(), 3.0, 0.3);
}

// Both clocks are read after the pulse, by other means than the driver's.
TEST_F(PulsingDevice, IsStampedOnTheHostsClockAsTheKernelShowsItOnTheWallClock) {
  for (int i = 0; i < 10; ++i) {
    const auto edge = next();
    ASSERT_TRUE(edge);
    const WallTime stamp = shown();
    const WallReading reading = clock_.wall();
    const std::chrono::nanoseconds error = edge->time - (reading.host + (stamp - reading.wall));
    std::printf("pulse %d: %.1f us off, read to %.1f us, %.0f ms after it\n", i,
                1e-3 * static_cast<double>(error.count()),
                0.5e-3 * static_cast<double>(reading.spread.count()),
                1e-6 * static_cast<double>((reading.host - edge->time).count()));
    // Half of the spread of each of three readings, and what the wall clock may be slewed since.
    EXPECT_LE(std::chrono::abs(error), 3 * reading.spread + 500us);
  }
}

}  // namespace
}  // namespace plumbline::posix
