// SPDX-License-Identifier: MIT
#include "sim/sim_trigger_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace plumbline::sim {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

// A line, and what came in over it when the far end drove it `count` times, active for 20 ms of
// every second.
struct Heard {
  std::vector<LineEdge> edges;
  std::uint64_t lost = 0;
  std::vector<std::string> faults;

  void operator()(const LineEvent& event) {
    if (const auto* edge = std::get_if<LineEdge>(&event)) edges.push_back(*edge);
    if (const auto* gap = std::get_if<EdgesLost>(&event)) lost += gap->count;
    if (const auto* fault = std::get_if<LineFault>(&event)) faults.push_back(fault->sentence);
  }
};

Heard hear(int count, TriggerLineFaults faults) {
  VirtualClock clock;
  SimTriggerLine line(clock, 1ms, 1, faults);
  Heard heard;
  EXPECT_TRUE(line.listen([&](const LineEvent& event) { heard(event); }).ok());
  for (int i = 0; i < count; ++i) {
    line.drive(HostTime(i * 1s), true);
    line.drive(HostTime(i * 1s + 20ms), false);
  }
  clock.run_until(HostTime(count * 1s));
  return heard;
}

TEST(SimTriggerLine, RemembersItsPulsesAndLivesThroughThem) {
  VirtualClock clock(HostTime(5s));
  SimTriggerLine line(clock, 20ms);
  ASSERT_TRUE(line.pulse().ok());
  EXPECT_EQ(clock.now(), HostTime(5s + 20ms));
  ASSERT_EQ(line.pulses().size(), 1u);
  EXPECT_EQ(line.pulses()[0].before, HostTime(5s));
}

TEST(SimTriggerLine, StampsEdgesExactlyUnlessToldOtherwise) {
  const Heard heard = hear(2, {});
  ASSERT_EQ(heard.edges.size(), 4u);
  EXPECT_EQ(heard.edges[2].time, HostTime(1s));
  EXPECT_TRUE(heard.edges[2].rising);
  EXPECT_EQ(heard.edges[3].time, HostTime(1s + 20ms));
  EXPECT_FALSE(heard.edges[3].rising);
}

TEST(SimTriggerLine, TurnsEveryEdgeRoundWhereItIsInverted) {
  const Heard heard = hear(1, {.inverted = true});
  ASSERT_EQ(heard.edges.size(), 2u);
  EXPECT_FALSE(heard.edges[0].rising);
  EXPECT_TRUE(heard.edges[1].rising);
}

TEST(SimTriggerLine, BouncesBackAndForthWhereEdgesAreDoubled) {
  const Heard heard = hear(1, {.doubled = 1});
  ASSERT_EQ(heard.edges.size(), 6u);
  std::string directions;
  for (const LineEdge& edge : heard.edges) directions += edge.rising ? '/' : '\\';
  EXPECT_EQ(directions, "/\\/\\/\\");
}

// Of 2000 edges 200 +- 13 (one sigma) are lost; bounds of five sigma.
TEST(SimTriggerLine, LosesEdgesAndCountsThem) {
  const Heard heard = hear(1000, {.lost = 0.1});
  const auto missing = static_cast<double>(2000 - heard.edges.size());
  EXPECT_NEAR(missing, 200.0, 5 * std::sqrt(2000 * 0.1 * 0.9));
  EXPECT_LE(heard.edges.back().sequence + 1, 2000u);
  EXPECT_EQ(heard.edges.back().sequence + 1, heard.edges.size() + heard.lost);
}

// The mean of the absolute value of a normal variable is sigma * sqrt(2 / pi), its own deviation
// 0.6 sigma; bounds of five sigma of the mean.
TEST(SimTriggerLine, StampsEdgesLateByTheJitter) {
  const Heard heard = hear(1000, {.jitter_sigma = 50us});
  ASSERT_EQ(heard.edges.size(), 2000u);
  double sum_us = 0;
  for (std::size_t i = 0; i < heard.edges.size(); i += 2) {
    const auto late = heard.edges[i].time - HostTime(static_cast<int>(i / 2) * 1s);
    EXPECT_GE(late, 0ns);
    sum_us += std::chrono::duration<double, std::micro>(late).count();
  }
  EXPECT_NEAR(sum_us / 1000, 50 * std::sqrt(2 / M_PI), 5 * 30 / std::sqrt(1000.0));
}

TEST(SimTriggerLine, SaysOnceThatItsChipIsGone) {
  VirtualClock clock;
  SimTriggerLine line(clock, 1ms);
  Heard heard;
  ASSERT_TRUE(line.listen([&](const LineEvent& event) { heard(event); }).ok());
  line.unplug(HostTime(1s));
  line.drive(HostTime(2s), true);
  clock.run_until(HostTime(3s));
  EXPECT_TRUE(heard.edges.empty());
  EXPECT_THAT(heard.faults, ElementsAre(HasSubstr("plug it in again")));
}

}  // namespace
}  // namespace plumbline::sim
