// SPDX-License-Identifier: MIT
#include "tests/contract/trigger_line_contract.h"

namespace plumbline::contract {

using namespace std::chrono_literals;

void TriggerLineContract::SetUp() {
  if (!bench_->why_not().empty()) GTEST_SKIP() << bench_->why_not();
}

void TriggerLineContract::listen() {
  const Status listening = bench_->line().listen([this](LineEvent event) {
    const std::lock_guard lock(mutex_);
    if (const auto* edge = std::get_if<LineEdge>(&event)) edges_.push_back(*edge);
  });
  ASSERT_TRUE(listening.ok()) << listening.error().sentence;
}

std::vector<LineEdge> TriggerLineContract::edges() const {
  const std::lock_guard lock(mutex_);
  return edges_;
}

void TriggerLineContract::wait_for_edges(std::size_t count) {
  for (int i = 0; i < 100 && edges().size() < count; ++i) bench_->pass(10ms);
}

namespace {

TEST_P(TriggerLineContract, PutsOutAPulseThatIsNotShorterThanAskedFor) {
  const HostTime asked = bench_->clock().now();
  const auto pulse = bench_->line().pulse();
  ASSERT_TRUE(pulse.ok()) << pulse.error().sentence;
  EXPECT_GE(pulse->before, asked);
  EXPECT_GE(pulse->after, pulse->before);
  EXPECT_GE(pulse->width, bench_->pulse_width());
  EXPECT_GE(bench_->clock().now(), pulse->after + bench_->pulse_width());
}

TEST_P(TriggerLineContract, StampsEdgesAtTheTimeTheyHappen) {
  listen();
  const HostTime before = bench_->clock().now();
  bench_->drive(true);
  wait_for_edges(1);
  const HostTime between = bench_->clock().now();
  bench_->drive(false);
  wait_for_edges(2);
  const auto seen = edges();
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_TRUE(seen[0].rising);
  EXPECT_FALSE(seen[1].rising);
  EXPECT_GE(seen[0].time, before);
  EXPECT_LE(seen[0].time, between);
  EXPECT_GE(seen[1].time, between);
  EXPECT_LE(seen[1].time, bench_->clock().now());
}

TEST_P(TriggerLineContract, NumbersEdgesWithoutAGap) {
  listen();
  for (int i = 0; i < 10; ++i) {
    bench_->drive(i % 2 == 0);
    wait_for_edges(static_cast<std::size_t>(i) + 1);
  }
  const auto seen = edges();
  ASSERT_EQ(seen.size(), 10u);
  for (std::size_t i = 0; i < seen.size(); ++i) EXPECT_EQ(seen[i].sequence, i);
}

TEST_P(TriggerLineContract, IsListenedToByOneAtATime) {
  listen();
  EXPECT_FALSE(bench_->line().listen([](const LineEvent&) {}).ok());
}

TEST_P(TriggerLineContract, SaysNothingOfWhatHappenedWhileNobodyListened) {
  listen();
  bench_->line().stop();
  bench_->drive(true);
  bench_->pass(50ms);
  EXPECT_TRUE(edges().empty());
  bench_->drive(false);
  bench_->pass(50ms);
  listen();
  bench_->drive(true);
  wait_for_edges(1);
  const auto seen = edges();
  ASSERT_EQ(seen.size(), 1u);
  EXPECT_TRUE(seen[0].rising);
  EXPECT_EQ(seen[0].sequence, 0u);
}

TEST_P(TriggerLineContract, PulsesWhileItListens) {
  listen();
  ASSERT_TRUE(bench_->line().pulse().ok());
  bench_->drive(true);
  wait_for_edges(1);
  EXPECT_EQ(edges().size(), 1u);
}

}  // namespace
}  // namespace plumbline::contract
