// SPDX-License-Identifier: MIT
#include "drivers/text_queue.h"

#include <gtest/gtest.h>

namespace plumbline {
namespace {

using std::chrono::milliseconds;

TEST(TextQueue, GivesTextsInTheirOrder) {
  TextQueue queue;
  queue.push({PilotSeverity::kInfo, "first", HostTime{}});
  queue.push({PilotSeverity::kError, "second", HostTime{}});
  EXPECT_EQ(queue.pop(HostTime{}).value().text, "first");
  EXPECT_EQ(queue.pop(HostTime{}).value().severity, PilotSeverity::kError);
  EXPECT_FALSE(queue.pop(HostTime{}));
  EXPECT_EQ(queue.dropped(), 0u);
}

TEST(TextQueue, DropsATextThatWaitedForTenSeconds) {
  TextQueue queue;
  queue.push({PilotSeverity::kInfo, "old", HostTime{}});
  queue.push({PilotSeverity::kInfo, "young", HostTime{milliseconds(2)}});
  EXPECT_EQ(queue.pop(HostTime{milliseconds(10001)}).value().text, "young");
  EXPECT_EQ(queue.dropped(), 1u);
}

TEST(TextQueue, DropsTheOldestOfMoreThanThirtyTwo) {
  TextQueue queue;
  for (int i = 0; i < 33; ++i) queue.push({PilotSeverity::kInfo, std::to_string(i), HostTime{}});
  EXPECT_EQ(queue.pop(HostTime{}).value().text, "1");
  EXPECT_EQ(queue.dropped(), 1u);
}

}  // namespace
}  // namespace plumbline
