// SPDX-License-Identifier: MIT
#include "edge/base/ring.h"

#include <gtest/gtest.h>

#include <deque>

namespace plumbline {
namespace {

TEST(Ring, HoldsTheNewestInOrderAsAQueueWould) {
  Ring<int> ring(5);
  std::deque<int> queue;
  for (int k = 0; k < 100; ++k) {
    ring.push_back(k);
    queue.push_back(k);
    if (queue.size() > 5) queue.pop_front();
    if (k % 7 == 3) {
      ring.pop_front();
      queue.pop_front();
    }
    ASSERT_EQ(ring.size(), queue.size());
    EXPECT_EQ(ring.front(), queue.front());
    EXPECT_EQ(ring.back(), queue.back());
    for (std::size_t i = 0; i < queue.size(); ++i) EXPECT_EQ(ring[i], queue[i]);
  }
}

TEST(Ring, BeginsAnewWhenItIsCleared) {
  Ring<int> ring(2);
  ring.push_back(1);
  ring.push_back(2);
  ring.clear();
  EXPECT_TRUE(ring.empty());
  ring.push_back(3);
  EXPECT_EQ(ring.front(), 3);
  EXPECT_EQ(ring.back(), 3);
}

}  // namespace
}  // namespace plumbline
