// SPDX-License-Identifier: MIT
#include "edge/base/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <vector>

namespace plumbline {
namespace {

class ParallelForOnThreads : public testing::TestWithParam<int> {};

TEST_P(ParallelForOnThreads, VisitsEveryIndexOnce) {
  constexpr int kCount = 10'000;
  std::vector<std::atomic<int>> visits(kCount);
  parallel_for(kCount, GetParam(), [&](int i) { ++visits[static_cast<std::size_t>(i)]; });
  for (const std::atomic<int>& visit : visits) EXPECT_EQ(visit, 1);
}

TEST_P(ParallelForOnThreads, GivesTheSameBitsAsOneThread) {
  const auto table = [](int threads) {
    std::vector<double> sines(5000);
    parallel_for(5000, threads,
                 [&](int i) { sines[static_cast<std::size_t>(i)] = std::sin(0.37 * i); });
    return sines;
  };
  EXPECT_EQ(table(GetParam()), table(1));
}

TEST_P(ParallelForOnThreads, DoesNothingForNoIndices) {
  int calls = 0;
  parallel_for(0, GetParam(), [&](int) { ++calls; });
  EXPECT_EQ(calls, 0);
}

INSTANTIATE_TEST_SUITE_P(Threads, ParallelForOnThreads, testing::Values(1, 2, 8));

TEST(ParallelFor, TakesFewerThanOneThreadForOne) {
  int calls = 0;
  parallel_for(3, 0, [&](int) { ++calls; });
  EXPECT_EQ(calls, 3);
}

// Both calls wait for each other: one thread alone would never come to the end.
TEST(ParallelFor, RunsTwoCallsAtTheSameTime) {
  std::mutex mutex;
  std::condition_variable arrival;
  int arrived = 0;
  parallel_for(2, 2, [&](int) {
    std::unique_lock lock(mutex);
    ++arrived;
    arrival.notify_all();
    arrival.wait(lock, [&] { return arrived == 2; });
  });
  EXPECT_EQ(arrived, 2);
}

}  // namespace
}  // namespace plumbline
