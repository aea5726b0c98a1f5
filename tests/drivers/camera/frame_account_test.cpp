// SPDX-License-Identifier: MIT
#include "drivers/camera/frame_account.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

using std::chrono::milliseconds;

HostTime at_ms(int ms) { return HostTime(milliseconds(ms)); }

FrameAccount of_ten_a_second() {
  FrameAccount account;
  account.set_period(milliseconds(100));
  return account;
}

TEST(FrameAccount, LeavesNoGapWhereNothingWasLost) {
  FrameAccount account = of_ten_a_second();
  EXPECT_EQ(account.frame(7, at_ms(0)).sequence, 0u);
  EXPECT_EQ(account.frame(8, at_ms(100)).sequence, 1u);
  EXPECT_EQ(account.frame(9, at_ms(350)).lost_before, 0u) << "the device's count is trusted";
}

TEST(FrameAccount, LeavesAGapForEachFrameThatTheDeviceCountsAndDidNotDeliver) {
  FrameAccount account = of_ten_a_second();
  account.frame(4, at_ms(0));
  const FrameAccount::Counted counted = account.frame(8, at_ms(400));
  EXPECT_EQ(counted.lost_before, 3u);
  EXPECT_EQ(counted.sequence, 4u);
}

TEST(FrameAccount, CountsOnWhereTheDeviceWrapsAround) {
  FrameAccount account = of_ten_a_second();
  account.frame(0xFFFFFFFE, at_ms(0));
  EXPECT_EQ(account.frame(1, at_ms(300)).lost_before, 2u);
}

TEST(FrameAccount, CountsAnOutageByTime) {
  FrameAccount account = of_ten_a_second();
  account.frame(50, at_ms(0));
  account.restarted();
  const FrameAccount::Counted counted = account.frame(0, at_ms(2010));
  EXPECT_EQ(counted.lost_before, 19u);
  EXPECT_EQ(counted.sequence, 20u);
}

TEST(FrameAccount, CountsADamagedFrameAsLostWithThoseBeforeIt) {
  FrameAccount account = of_ten_a_second();
  account.frame(0, at_ms(0));
  EXPECT_EQ(account.damaged(2, at_ms(200)), 2u);
  const FrameAccount::Counted counted = account.frame(3, at_ms(300));
  EXPECT_EQ(counted.lost_before, 0u);
  EXPECT_EQ(counted.sequence, 3u);
}

TEST(FrameAccount, KnowsAFrameThatWasOvertaken) {
  FrameAccount account = of_ten_a_second();
  account.frame(5, at_ms(0));
  EXPECT_EQ(account.frame(7, at_ms(200)).lost_before, 1u);
  EXPECT_TRUE(account.is_late(6));
  EXPECT_FALSE(account.is_late(8));
  account.restarted();
  EXPECT_FALSE(account.is_late(6));
}

TEST(FrameAccount, CountsByTimeWhereTheDeviceDoesNotCount) {
  FrameAccount account = of_ten_a_second();
  account.frame(0, at_ms(0));
  EXPECT_FALSE(account.is_late(0));
  EXPECT_EQ(account.frame(0, at_ms(110)).lost_before, 0u);
  EXPECT_EQ(account.frame(0, at_ms(400)).lost_before, 2u);
}

}  // namespace
}  // namespace plumbline
