// SPDX-License-Identifier: MIT
#include "drivers/camera/exposure_history.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "drivers/camera/exposure_model.h"

namespace plumbline {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr milliseconds kPeriod{50};

HostTime at(std::chrono::milliseconds time) { return HostTime(time); }

ExposureHistory from_two_to_one_at_1000() {
  ExposureHistory history;
  history.set(HostTime{}, milliseconds(2));
  history.set(at(milliseconds(1000)), milliseconds(1));
  return history;
}

TEST(ExposureHistory, KnowsNothingBeforeAnythingIsSet) {
  EXPECT_FALSE(ExposureHistory{}.of_frame(at(milliseconds(1)), kPeriod));
}

TEST(ExposureHistory, IsSureOfTheFirstSetting) {
  ExposureHistory history;
  history.set(at(milliseconds(1000)), milliseconds(2));
  const auto exposure = history.of_frame(at(milliseconds(1001)), kPeriod);
  EXPECT_EQ(exposure->mean, milliseconds(2));
  EXPECT_EQ(exposure->sigma, nanoseconds(0));
}

TEST(ExposureHistory, KeepsTheOldExposureForAFrameThatBeganBeforeTheNewOneWasSet) {
  const auto exposure = from_two_to_one_at_1000().of_frame(at(milliseconds(999)), kPeriod);
  EXPECT_EQ(exposure->mean, milliseconds(2));
  EXPECT_EQ(exposure->sigma, nanoseconds(0));
}

TEST(ExposureHistory, DoubtsTheNextFramesAndThenBelievesTheNewExposure) {
  const ExposureHistory history = from_two_to_one_at_1000();
  for (const int ms : {1000, 1050, 1399}) {
    const auto doubted = history.of_frame(at(milliseconds(ms)), kPeriod);
    EXPECT_EQ(doubted->mean, microseconds(1500)) << ms;
    EXPECT_EQ(doubted->sigma, microseconds(500)) << ms;
  }
  const auto settled = history.of_frame(at(milliseconds(1400)), kPeriod);
  EXPECT_EQ(settled->mean, milliseconds(1));
  EXPECT_EQ(settled->sigma, nanoseconds(0));
}

TEST(ExposureHistory, SpansAllThatWasSetWhileNothingHadSettled) {
  ExposureHistory history = from_two_to_one_at_1000();
  history.set(at(milliseconds(1100)), milliseconds(5));
  const auto exposure = history.of_frame(at(milliseconds(1150)), kPeriod);
  EXPECT_EQ(exposure->mean, milliseconds(3));
  EXPECT_EQ(exposure->sigma, milliseconds(2));
  EXPECT_EQ(history.of_frame(at(milliseconds(1400)), kPeriod)->mean, milliseconds(3))
      << "the first change has settled, to 1 ms; the second may hold or not";
}

// A camera that takes a new exposure at a frame of its choice: the stated sigma must be the error
// of the middle, RMS, besides the jitter that the model allows for.
TEST(ExposureHistory, StatesWhatTheMiddleOfTheExposureIsOffBy) {
  std::mt19937 random(1);
  const ExposureHistory history = from_two_to_one_at_1000();
  constexpr int kFrames = 4000;
  double squares = 0;
  double stated = 0;
  for (int i = 0; i < kFrames; ++i) {
    const HostTime start = at(milliseconds(1100));
    const bool new_holds = random() % 2 == 0;
    ExposureModel model{StampMeaning::kStartOfExposure, kPeriod, history.of_frame(start, kPeriod),
                        nanoseconds(0), 100};
    const ExposureTiming timing = exposure_of(start, model);
    const HostTime middle = start + (new_holds ? microseconds(500) : microseconds(1000));
    const double error_ms =
        std::chrono::duration<double, std::milli>(timing.middle_of_row(0) - middle).count();
    squares += error_ms * error_ms;
    stated = std::chrono::duration<double, std::milli>(timing.sigma).count();
  }
  const double jitter_ms = 0.1;
  EXPECT_NEAR(std::sqrt(squares / kFrames), std::sqrt(stated * stated - jitter_ms * jitter_ms),
              0.01);
}

}  // namespace
}  // namespace plumbline
