// SPDX-License-Identifier: MIT
#include "drivers/camera/control_plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <linux/v4l2-controls.h>

#include <algorithm>

namespace plumbline {
namespace {

using std::chrono::microseconds;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

V4l2Control control(std::uint32_t id, std::int64_t minimum, std::int64_t maximum,
                    std::int64_t usual) {
  return {id, "c", minimum, maximum, 1, usual, usual, false, {}};
}

V4l2Control exposure_modes(std::vector<std::int64_t> choices) {
  return {V4L2_CID_EXPOSURE_AUTO, "Auto Exposure", 0, 3, 1, 3, 3, false, std::move(choices)};
}

// A usual webcam: aperture priority or manual, no automatic gain of its own.
std::vector<V4l2Control> webcam() {
  return {exposure_modes({V4L2_EXPOSURE_MANUAL, V4L2_EXPOSURE_APERTURE_PRIORITY}),
          control(V4L2_CID_EXPOSURE_ABSOLUTE, 3, 2047, 250),
          control(V4L2_CID_EXPOSURE_AUTO_PRIORITY, 0, 1, 1),
          control(V4L2_CID_GAIN, 0, 255, 64),
          control(V4L2_CID_FOCUS_AUTO, 0, 1, 1),
          control(V4L2_CID_FOCUS_ABSOLUTE, 0, 250, 30),
          control(V4L2_CID_ZOOM_ABSOLUTE, 100, 500, 100)};
}

std::optional<std::int64_t> value(const ControlPlan& plan, std::uint32_t id) {
  for (const ControlSetting& setting : plan.settings) {
    if (setting.id == id) return setting.value;
  }
  return std::nullopt;
}

TEST(ControlPlan, BoundsTheExposureOfAWebcamByMakingItManual) {
  const ControlPlan plan = plan_controls(webcam(), {}, std::nullopt);
  EXPECT_EQ(value(plan, V4L2_CID_EXPOSURE_AUTO), V4L2_EXPOSURE_MANUAL);
  EXPECT_EQ(value(plan, V4L2_CID_EXPOSURE_ABSOLUTE), 20);  // of 100 us
  EXPECT_TRUE(plan.exposure_known);
  ASSERT_EQ(plan.notices.size(), 1u);
  EXPECT_THAT(plan.notices[0], HasSubstr("suit its gain to the light"));
}

TEST(ControlPlan, PrefersShutterPriorityUnlessBothAreFixed) {
  auto controls = webcam();
  controls[0] = exposure_modes({0, 1, V4L2_EXPOSURE_SHUTTER_PRIORITY, 3});
  EXPECT_EQ(value(plan_controls(controls, {}, std::nullopt), V4L2_CID_EXPOSURE_AUTO),
            V4L2_EXPOSURE_SHUTTER_PRIORITY);
  CameraOptions fixed;
  fixed.fixed_exposure = true;
  EXPECT_EQ(value(plan_controls(controls, fixed, std::nullopt), V4L2_CID_EXPOSURE_AUTO),
            V4L2_EXPOSURE_MANUAL);
}

TEST(ControlPlan, TurnsOffAllThatMovesBeforeItSetsValues) {
  const ControlPlan plan = plan_controls(webcam(), {}, 77);
  EXPECT_EQ(value(plan, V4L2_CID_EXPOSURE_AUTO_PRIORITY), 0);
  EXPECT_EQ(value(plan, V4L2_CID_ZOOM_ABSOLUTE), 100);
  EXPECT_EQ(value(plan, V4L2_CID_FOCUS_AUTO), 0);
  EXPECT_EQ(value(plan, V4L2_CID_FOCUS_ABSOLUTE), 77) << "the lens goes back where it stood";
  const auto place = [&plan](std::uint32_t id) {
    return std::find_if(plan.settings.begin(), plan.settings.end(),
                        [id](const ControlSetting& setting) { return setting.id == id; });
  };
  EXPECT_LT(place(V4L2_CID_FOCUS_AUTO), place(V4L2_CID_FOCUS_ABSOLUTE));
  EXPECT_LT(place(V4L2_CID_EXPOSURE_AUTO), place(V4L2_CID_EXPOSURE_ABSOLUTE));
}

TEST(ControlPlan, LeavesTheLensWhereItIsUnlessItWasElsewhere) {
  EXPECT_FALSE(value(plan_controls(webcam(), {}, std::nullopt), V4L2_CID_FOCUS_ABSOLUTE));
}

TEST(ControlPlan, SaysThatExposureCannotBeBounded) {
  const ControlPlan plan = plan_controls({}, {}, std::nullopt);
  EXPECT_THAT(plan.settings, IsEmpty());
  EXPECT_FALSE(plan.exposure_known);
  ASSERT_EQ(plan.notices.size(), 1u);
  EXPECT_THAT(plan.notices[0], HasSubstr("may blur"));
}

TEST(ControlPlan, SaysThatTheShortestExposureIsTooLong) {
  auto controls = webcam();
  controls[1].minimum = 50;
  const ControlPlan plan = plan_controls(controls, {}, std::nullopt);
  EXPECT_EQ(value(plan, V4L2_CID_EXPOSURE_ABSOLUTE), 50);
  EXPECT_THAT(plan.notices, ::testing::Contains(HasSubstr("shortest exposure is 5000 us")));
}

TEST(ControlPlan, RoundsExposureDownToTheCamerasSteps) {
  auto controls = webcam();
  controls[1].step = 7;
  EXPECT_EQ(exposure_setting(controls, microseconds(2050))->value, 17);  // 3 + 2 * 7
}

TEST(ControlPlan, FixesGainInTheCamerasOwnSteps) {
  CameraOptions options;
  options.fixed_gain = 1000;
  const ControlPlan plan = plan_controls(webcam(), options, std::nullopt);
  EXPECT_EQ(value(plan, V4L2_CID_GAIN), 255);
  EXPECT_THAT(plan.notices, ::testing::Contains(HasSubstr("0 to 255")));
}

TEST(ControlPlan, PassesOverControlsThatCannotBeSet) {
  auto controls = webcam();
  for (V4l2Control& control : controls) control.read_only = true;
  EXPECT_THAT(plan_controls(controls, {}, 5).settings, IsEmpty());
}

}  // namespace
}  // namespace plumbline
