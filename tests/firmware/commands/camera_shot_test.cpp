// SPDX-License-Identifier: MIT
#include "firmware/commands/camera_shot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "edge/jpeg/jpeg.h"
#include "sim/sim_camera.h"
#include "sim/virtual_clock.h"

namespace plumbline::commands {
namespace {

using ::testing::HasSubstr;

struct Bench {
  sim::VirtualClock clock{HostTime(std::chrono::seconds(5))};
  sim::SimCamera camera{clock, {}};

  Result<Shot> shoot(const ShotOptions& options = {}) {
    return take_shot(camera, options, [this](Signal& signal, std::chrono::nanoseconds longest) {
      if (clock.wait(signal, clock.now() + longest)) signal.raise();
    });
  }
};

TEST(CameraShot, TakesAPhotoOnceTheCameraHasSettled) {
  Bench bench;
  const Result<Shot> shot = bench.shoot();
  ASSERT_TRUE(shot) << shot.error().sentence;
  EXPECT_EQ(shot->width_px, 16);
  EXPECT_EQ(jpeg::read_header(shot->file, "shot")->height_px, 12);
  EXPECT_GE(shot->frame.sequence, 10u) << "one second at 10 frames a second is let by";
}

TEST(CameraShot, FailsWithTheCamerasOwnSentence) {
  Bench bench;
  bench.camera.unplug();
  EXPECT_THAT(bench.shoot().error().sentence, HasSubstr("plug it in"));
  bench.camera.plug_in();
  bench.camera.silence(true);
  EXPECT_THAT(bench.shoot().error().sentence,
              HasSubstr("No photo in 10 s. The camera has stopped"));
}

TEST(CameraShot, RefusesASizeThatTheCameraDoesNotHave) {
  Bench bench;
  ShotOptions options;
  options.camera.width_px = 4000;
  EXPECT_THAT(bench.shoot(options).error().sentence, HasSubstr("no mode 4000 x 12"));
}

TEST(CameraShot, LeavesTheCameraStopped) {
  Bench bench;
  ASSERT_TRUE(bench.shoot());
  EXPECT_TRUE(bench.shoot()) << "it can be started again";
}

}  // namespace
}  // namespace plumbline::commands
