// SPDX-License-Identifier: MIT
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "sim/random.h"
#include "tests/contract/camera_contract.h"

namespace plumbline::contract {
namespace {

using std::chrono::milliseconds;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr milliseconds kReturn{15000};

std::ptrdiff_t open_descriptors() {
  const std::filesystem::directory_iterator folder("/proc/self/fd");
  return std::distance(begin(folder), end(folder));
}

// Mean and largest of what was measured, for a person who reads the log.
class Spread {
 public:
  void add(std::chrono::nanoseconds value) {
    const double value_ms = Milliseconds(value).count();
    sum_ms_ += value_ms;
    most_ms_ = std::max(most_ms_, value_ms);
    ++count_;
  }
  void print(const char* what) const {
    std::printf("%s: mean %.0f ms, longest %.0f ms, of %d\n", what, sum_ms_ / std::max(count_, 1),
                most_ms_, count_);
  }

 private:
  double sum_ms_ = 0, most_ms_ = 0;
  int count_ = 0;
};

// Mean from one frame to the next where none was lost.
Milliseconds usual_interval(const std::vector<Frame>& frames) {
  Milliseconds sum{0};
  int count = 0;
  for (std::size_t i = 1; i < frames.size(); ++i) {
    if (frames[i].sequence != frames[i - 1].sequence + 1) continue;
    sum += frames[i].timing.first_row_start - frames[i - 1].timing.first_row_start;
    ++count;
  }
  return sum / std::max(count, 1);
}

// How many frames more, or fewer, were counted as lost before `after` than time had room for.
double error_of_account(const Frame& before, const Frame& after, Milliseconds interval) {
  const Milliseconds gap = after.timing.first_row_start - before.timing.first_row_start;
  return static_cast<double>(after.sequence - before.sequence) - gap / interval;
}

HostTime time_of(const std::vector<CameraReport>& reports, CameraState state, std::size_t after) {
  const auto from = reports.begin() + static_cast<std::ptrdiff_t>(after);
  return std::find_if(from, reports.end(), [state](const auto& r) { return r.state == state; })
      ->time;
}

// For a person who wonders why a camera did not come back.
std::string told(const std::vector<CameraReport>& reports, std::size_t after) {
  std::string sentences;
  for (std::size_t i = after; i < reports.size(); ++i) sentences += reports[i].sentence + "\n";
  return sentences;
}

TEST_P(CameraContract, IsBackAfterEachOfManyPullsAndHasCountedWhatItMissed) {
  sim::Random random(20261120, 51);
  const auto some_time = [&] { return milliseconds(static_cast<int>(random.uniform(0, 250))); };
  const std::ptrdiff_t descriptors = open_descriptors();
  Spread until_reported, until_back;
  std::vector<std::size_t> back;  // the first frame after each pull
  start();
  ASSERT_TRUE(frames_come(30, kReturn));  // a driver that is not told the rate has learnt it
  for (int pull = 0; pull < bench_->pulls(); ++pull) {
    bench_->pass(some_time());
    const std::size_t reported = events_.reports().size();
    const HostTime pulled = bench_->now();
    if (!bench_->unplug()) GTEST_SKIP() << "this camera cannot be unplugged";
    ASSERT_TRUE(reports(CameraState::kAbsent, reported, detection_limit())) << pull;
    until_reported.add(time_of(events_.reports(), CameraState::kAbsent, reported) - pulled);
    back.push_back(events_.frames().size());
    bench_->pass(some_time());
    const HostTime put_back = bench_->now();
    bench_->plug_in();
    ASSERT_TRUE(reports(CameraState::kStreaming, reported + 1, kReturn))
        << pull << "\n"
        << told(events_.reports(), reported);
    until_back.add(events_.reports().back().time - put_back);
    ASSERT_TRUE(frames_come(2, kReturn)) << pull;
  }
  until_reported.print("from the pull to its report");
  until_back.print("from the return to its first frame");
  const std::vector<Frame> frames = events_.frames();
  const auto period = bench_->period();
  const Milliseconds interval = period ? Milliseconds(*period) : usual_interval(frames);
  for (const std::size_t first : back) {
    EXPECT_NEAR(error_of_account(frames[first - 1], frames[first], interval), 0, 1)
        << "frame " << first << " at " << interval.count() << " ms";
  }
  camera_->stop();
  EXPECT_EQ(open_descriptors(), descriptors);
}

}  // namespace
}  // namespace plumbline::contract
