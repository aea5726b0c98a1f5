// SPDX-License-Identifier: MIT
#include "firmware/service/adviser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <string>
#include <vector>

namespace plumbline::service {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;

plan::Options calibrated() {
  plan::Options options;
  geometry::Camera& camera = options.camera;
  camera.width_px = 4000;
  camera.height_px = 2250;
  camera.interior << 2125, 1999.5, 1124.5, 0, 0, 0, 0, 0, 0, 0;
  camera.sigma.setZero();
  options.goal_m = 0.05;
  return options;
}

class AskedAdviser : public testing::Test {
 protected:
  AskedAdviser() : adviser_(calibrated(), [this](const Advice& advice) { keep(advice); }) {}

  void fly() {
    adviser_.decided({HostTime{}, capture::PhaseChanged{capture::Phase::kFlying, 0.0}});
  }

  void photograph(double east_m, double height_m) {
    capture::PhotoTaken taken;
    taken.place.emplace();
    taken.place->in_enu_m = {east_m, 0, height_m};
    taken.place->height_m = height_m;
    taken.place->quality = FixQuality::kFixed;
    adviser_.decided({HostTime{}, taken});
  }

  // The next advice; none after a minute.
  Advice next() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::minutes(1), [this] { return given_ < advice_.size(); });
    return given_ < advice_.size() ? advice_[given_++] : Advice{};
  }

 private:
  void keep(const Advice& advice) {
    EXPECT_LE(advice.short_text.size(), 50u) << advice.short_text;
    const std::lock_guard lock(mutex_);
    advice_.push_back(advice);
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Advice> advice_;
  std::size_t given_ = 0;
  Adviser adviser_;  // the last: it ends before what it calls
};

// papers/vertical.md: photos on one vertical line say nothing about north.
TEST_F(AskedAdviser, SendsAClimbWithoutASideStepAside) {
  fly();
  photograph(0, 70);
  photograph(0, 80);
  next();
  photograph(0, 90);
  const Advice advice = next();
  EXPECT_THAT(advice.sentence, AllOf(HasSubstr("azimuth unknown"), HasSubstr(" m aside")));
  EXPECT_THAT(advice.short_text, HasSubstr(": go "));
}

TEST_F(AskedAdviser, LetsAFlightLandThatReachesItsGoal) {
  fly();
  for (int height_m = 30; height_m <= 90; height_m += 10) photograph(0, height_m);
  photograph(10, 90);
  photograph(20, 90);
  Advice last = next();
  for (Advice more = last;
       !more.sentence.empty() && more.sentence.find("land") == std::string::npos;)
    last = more = next();
  EXPECT_THAT(last.sentence, AllOf(HasSubstr(": good, land."), Not(HasSubstr("unknown"))));
}

TEST_F(AskedAdviser, ForgetsTheFlightBefore) {
  fly();
  photograph(0, 70);
  photograph(10, 70);
  EXPECT_THAT(next().sentence, Not(HasSubstr("azimuth unknown")));
  fly();
  photograph(0, 70);
  photograph(0, 90);
  EXPECT_THAT(next().sentence, HasSubstr("azimuth unknown"));
}

}  // namespace
}  // namespace plumbline::service
