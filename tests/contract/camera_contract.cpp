// SPDX-License-Identifier: MIT
#include "tests/contract/camera_contract.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace plumbline::contract {
namespace {

using std::chrono::milliseconds;

// Beyond what the contract promises: how late a busy machine may wake this test.
constexpr milliseconds kMachine{1500};
constexpr milliseconds kStart{15000};  // cameras take seconds to begin
constexpr milliseconds kReturn{15000};

std::uint64_t sum_of(const RawImage& image) {
  return std::accumulate(image.bytes.begin(), image.bytes.end(), std::uint64_t{0});
}

}  // namespace

void CameraContract::SetUp() {
  if (!GetParam().make) GTEST_SKIP() << GetParam().why_not;
  bench_ = GetParam().make();
  camera_ = bench_->camera();
}

void CameraContract::TearDown() {
  if (!bench_) return;
  camera_.reset();
  bench_->mend();
  EXPECT_FALSE(events_.damaged());
  EXPECT_EQ(events_.disorder(), "");
}

void CameraContract::start() {
  const Status started = camera_->start(
      bench_->options(), [this](CameraEvent event) { events_.add(std::move(event)); });
  ASSERT_TRUE(started) << started.error().sentence;
}

bool CameraContract::until(const std::function<bool()>& holds, milliseconds at_most) {
  const HostTime deadline = bench_->now() + at_most;
  while (!holds()) {
    if (bench_->now() > deadline) return false;
    bench_->pass(milliseconds(5));
  }
  return true;
}

bool CameraContract::frames_come(std::size_t count, milliseconds at_most) {
  const std::size_t wanted = events_.frames().size() + count;
  return until([&] { return events_.frames().size() >= wanted; }, at_most);
}

bool CameraContract::reports(CameraState state, std::size_t after, milliseconds at_most) {
  return until(
      [&] {
        const auto reports = events_.reports();
        return std::any_of(reports.begin() + static_cast<std::ptrdiff_t>(after), reports.end(),
                           [state](const CameraReport& report) {
                             return report.state == state && !report.sentence.empty();
                           });
      },
      at_most);
}

// Two frame intervals or 1 s, whichever is longer.
milliseconds CameraContract::detection_limit() const {
  const auto frames = events_.frames();
  milliseconds interval{0};
  if (frames.size() >= 2) {
    interval = std::chrono::duration_cast<milliseconds>(
        (frames.back().timing.first_row_start - frames.front().timing.first_row_start) /
        (frames.back().sequence - frames.front().sequence));
  }
  return std::max(2 * interval, milliseconds(1000)) + kMachine;
}

TEST_P(CameraContract, SaysThatItStartsAndThenThatItStreams) {
  start();
  ASSERT_TRUE(frames_come(3, kStart));
  const auto reports = events_.reports();
  ASSERT_EQ(reports.size(), 2u);
  EXPECT_EQ(reports[0].state, CameraState::kStarting);
  EXPECT_EQ(reports[1].state, CameraState::kStreaming);
}

TEST_P(CameraContract, DeliversWholeFramesInOrderExposedBeforeTheyCame) {
  const HostTime before = bench_->now();
  start();
  ASSERT_TRUE(frames_come(10, kStart));
  const HostTime after = bench_->now();
  for (const Frame& frame : events_.frames()) {
    const auto slack = 5 * frame.timing.sigma;
    EXPECT_GT(frame.timing.middle_of_row(0), before - slack);
    EXPECT_LT(frame.timing.middle_of_row(0), after + slack);
    EXPECT_GT(frame.timing.sigma.count(), 0);
    EXPECT_EQ(frame.interior_number, 0);
  }
}

TEST_P(CameraContract, CallsNoMoreOnceStopHasReturned) {
  start();
  ASSERT_TRUE(frames_come(3, kStart));
  camera_->stop();
  const std::size_t count = events_.count();
  bench_->pass(milliseconds(300));
  EXPECT_EQ(events_.count(), count);
}

TEST_P(CameraContract, LeavesLentFramesReadableAfterItIsGone) {
  events_.hold(2);
  start();
  ASSERT_TRUE(frames_come(4, kStart));
  camera_->stop();
  const std::vector<Frame> held = events_.release();
  ASSERT_EQ(held.size(), 2u);
  const std::uint64_t before = sum_of(*held[0].image);
  camera_.reset();
  EXPECT_EQ(sum_of(*held[0].image), before);
}

TEST_P(CameraContract, StartsAgainAlsoWhileAnOldFrameIsHeld) {
  events_.hold(1);
  start();
  ASSERT_TRUE(frames_come(2, kStart));
  camera_->stop();
  const std::vector<Frame> held = events_.release();
  CameraEvents again;
  const Status started = camera_->start(
      bench_->options(), [&again](CameraEvent event) { again.add(std::move(event)); });
  ASSERT_TRUE(started) << started.error().sentence;
  EXPECT_TRUE(until([&] { return again.frames().size() >= 3; }, kStart));
  camera_->stop();
  EXPECT_EQ(again.disorder(), "");
}

TEST_P(CameraContract, RefusesToBeStartedTwice) {
  start();
  const Status again = camera_->start(bench_->options(), [](const CameraEvent&) {});
  ASSERT_FALSE(again);
  EXPECT_FALSE(again.error().sentence.empty());
}

TEST_P(CameraContract, RefusesASizeThatItDoesNotHave) {
  CameraOptions options = bench_->options();
  options.width_px = 60001;
  options.height_px = 7;
  const Status started = camera_->start(options, [](const CameraEvent&) {});
  ASSERT_FALSE(started);
  EXPECT_NE(started.error().sentence.find("60001 x 7"), std::string::npos)
      << started.error().sentence;
}

TEST_P(CameraContract, DescribesTheModeInWhichItStreams) {
  start();
  ASSERT_TRUE(frames_come(1, kStart));
  const Result<CameraDescription> description = camera_->describe();
  ASSERT_TRUE(description) << description.error().sentence;
  EXPECT_FALSE(description->name.empty());
  EXPECT_FALSE(description->modes.empty());
}

TEST_P(CameraContract, ReportsAMissingCameraAndIsNotRefused) {
  camera_ = bench_->missing_camera();
  if (!camera_) GTEST_SKIP() << "this camera cannot be missing from the beginning";
  start();
  EXPECT_TRUE(reports(CameraState::kAbsent, 0, milliseconds(1000) + kMachine));
}

TEST_P(CameraContract, CountsWhatIsLostWhileAllItsBuffersAreHeld) {
  events_.hold(100);
  start();
  ASSERT_TRUE(frames_come(1, kStart));
  std::size_t before = 0;
  // Until half a second brings no more frame: all are held.
  do {
    before = events_.frames().size();
    bench_->pass(milliseconds(500));
  } while (events_.frames().size() > before && before < 90);
  ASSERT_LT(before, 90u) << "its buffers never end";
  events_.release();
  ASSERT_TRUE(frames_come(3, kReturn));
  EXPECT_GT(events_.lost(), 0u);
}

TEST_P(CameraContract, AccountsForEachFrameThatIsDropped) {
  start();
  ASSERT_TRUE(frames_come(2, kStart));
  if (!bench_->inflict(CameraFault::kDrop)) GTEST_SKIP() << "this camera cannot be made to drop";
  ASSERT_TRUE(until([&] { return events_.lost() >= 5; }, kReturn));
  bench_->mend();
  ASSERT_TRUE(frames_come(3, kReturn));
  const auto frames = events_.frames();
  EXPECT_EQ(frames.back().sequence - frames.front().sequence + 1, frames.size() + events_.lost());
}

TEST_P(CameraContract, ReportsSilenceInTimeAndGoesOnAfterwards) {
  start();
  ASSERT_TRUE(frames_come(3, kStart));
  const std::size_t reported = events_.reports().size();
  if (!bench_->inflict(CameraFault::kSilence)) GTEST_SKIP() << "this camera cannot be silenced";
  EXPECT_TRUE(reports(CameraState::kStalled, reported, detection_limit()));
  bench_->mend();
  EXPECT_TRUE(reports(CameraState::kStreaming, reported + 1, kReturn));
  EXPECT_TRUE(frames_come(3, kReturn));
  EXPECT_GT(events_.lost(), 0u);
}

TEST_P(CameraContract, ReportsABrokenStreamInTimeAndGoesOnAfterwards) {
  start();
  ASSERT_TRUE(frames_come(3, kStart));
  const std::size_t reported = events_.reports().size();
  if (!bench_->inflict(CameraFault::kBrokenStream)) GTEST_SKIP() << "this stream cannot be broken";
  EXPECT_TRUE(reports(CameraState::kFailing, reported, detection_limit()));
  EXPECT_TRUE(reports(CameraState::kStreaming, reported + 1, kReturn));
  EXPECT_TRUE(frames_come(3, kReturn));
}

TEST_P(CameraContract, ReportsAPulledPlugInTimeAndGoesOnWhenItIsBack) {
  start();
  ASSERT_TRUE(frames_come(3, kStart));
  const std::size_t reported = events_.reports().size();
  if (!bench_->unplug()) GTEST_SKIP() << "this camera cannot be unplugged";
  EXPECT_TRUE(reports(CameraState::kAbsent, reported, detection_limit()));
  const std::size_t frames = events_.frames().size();
  bench_->pass(milliseconds(500));
  EXPECT_EQ(events_.frames().size(), frames);
  bench_->plug_in();
  EXPECT_TRUE(reports(CameraState::kStreaming, reported + 1, kReturn));
  EXPECT_TRUE(frames_come(3, kReturn));
  EXPECT_GT(events_.lost(), 0u) << "what was missed while it was away is not accounted for";
}

TEST_P(CameraContract, KeepsToANewBoundOnExposureOrSaysThatItCannot) {
  start();
  ASSERT_TRUE(frames_come(3, kStart));
  const auto half = bench_->options().longest_exposure / 2;
  camera_->limit_exposure(half);
  const bool kept = until(
      [&] { return events_.frames().back().timing.exposure <= std::chrono::nanoseconds(half); },
      milliseconds(3000));
  EXPECT_TRUE(kept || !events_.notices().empty());
}

GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(CameraContract);

}  // namespace plumbline::contract
