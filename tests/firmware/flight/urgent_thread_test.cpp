// SPDX-License-Identifier: MIT
#include "firmware/flight/urgent_thread.h"

#include <gtest/gtest.h>
#include <pthread.h>
#include <sched.h>

#include <thread>

namespace plumbline::flight {
namespace {

int policy() {
  int policy = -1;
  sched_param parameters{};
  ::pthread_getschedparam(::pthread_self(), &policy, &parameters);
  return policy;
}

int policy_of_a_new_thread() {
  int found = -1;
  std::thread([&] { found = policy(); }).join();
  return found;
}

TEST(UrgentThread, RunsFirstWithThoseItBeginsForAsLongAsItLives) {
  const int before = policy();
  {
    const UrgentThread urgent;
    if (!urgent.is_allowed()) {
      EXPECT_EQ(policy(), before);
      GTEST_SKIP() << "this system allows no real-time priority (RLIMIT_RTPRIO)";
    }
    EXPECT_EQ(policy(), SCHED_FIFO);
    EXPECT_EQ(policy_of_a_new_thread(), SCHED_FIFO);
  }
  EXPECT_EQ(policy(), before);
  EXPECT_EQ(policy_of_a_new_thread(), before);
}

}  // namespace
}  // namespace plumbline::flight
