// SPDX-License-Identifier: MIT
#include "sim/sim_receiver.h"

#include <gtest/gtest.h>

#include "edge/gnss/stream_decoder.h"

namespace plumbline::sim {
namespace {

// Each burst makes an earlier look necessary than the one that is waited for.
TEST(SimReceiver, HasAFewLooksToComeHoweverLongItTalks) {
  VirtualClock clock;
  SimReceiver receiver(clock, gnss::make_fix_decoder);
  ASSERT_TRUE(receiver.start([](const ReceiverEvent&) {}).ok());
  receiver.plug_in();
  for (int burst = 0; burst < 1000; ++burst) {
    receiver.send("$GNGGA,,,,,,0,,,,,,,,*78\r\n");
    clock.run_until(clock.now() + std::chrono::milliseconds(200));
  }
  EXPECT_LT(clock.pending(), 20u);
}

}  // namespace
}  // namespace plumbline::sim
