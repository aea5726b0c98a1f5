// SPDX-License-Identifier: MIT
#include "firmware/commands/camera_shot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

#include "edge/jpeg/jpeg.h"
#include "sim/sim_camera.h"
#include "sim/virtual_clock.h"

namespace plumbline::commands {
namespace {

using ::testing::ElementsAre;
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

// A sensor without processing, that says nothing of its colours: two frames, 2 s apart.
class RawSensor : public Camera {
 public:
  explicit RawSensor(PixelFormat format) : format_(format) {}

  Status start(const CameraOptions& options, Sink sink) override {
    asked_raw = options.raw;
    for (const int second : {1, 3}) {
      Frame frame;
      frame.timing.first_row_start = HostTime(std::chrono::seconds(second));
      frame.timing.exposure = std::chrono::milliseconds(1);
      frame.image = std::make_shared<const RawImage>(
          RawImage{format_, 64, 48, row_bytes(format_, 64), 0, LumaRange::kFull, bytes_});
      sink(std::move(frame));
    }
    return Done{};
  }
  void stop() override {}
  void limit_exposure(std::chrono::microseconds /*longest*/) override {}
  Result<CameraDescription> describe() override {
    return CameraDescription{"raw", "Sensor 477", "none", {}, {}};
  }

  bool asked_raw = false;

 private:
  PixelFormat format_;
  std::vector<std::uint8_t> bytes_ = std::vector<std::uint8_t>(64 * 48 * 2, 7);
};

Result<Shot> shoot_raw(RawSensor& sensor) {
  ShotOptions options;
  options.camera.raw = true;
  return take_shot(sensor, options,
                   [](Signal& /*signal*/, std::chrono::nanoseconds /*longest*/) {});
}

TEST(CameraShot, WritesARawFileAndSaysWhatTheCameraDoesNotKnowOfItsColours) {
  RawSensor sensor(PixelFormat::kBggr10Packed);
  const Result<Shot> shot = shoot_raw(sensor);
  ASSERT_TRUE(shot) << shot.error().sentence;
  EXPECT_TRUE(sensor.asked_raw);
  const std::string file(shot->file.begin(), shot->file.end());
  EXPECT_EQ(file.substr(0, 2), "II") << "a TIFF file";
  EXPECT_THAT(file, HasSubstr("Sensor 477"));
  EXPECT_THAT(shot->notices, ElementsAre(HasSubstr("without light"), HasSubstr("white balance")));
}

TEST(CameraShot, MakesNoRawFileOfAFinishedFrame) {
  RawSensor sensor(PixelFormat::kYuyv);
  EXPECT_THAT(shoot_raw(sensor).error().sentence, HasSubstr("YUYV is no raw frame"));
}

TEST(CameraShot, LeavesTheCameraStopped) {
  Bench bench;
  ASSERT_TRUE(bench.shoot());
  EXPECT_TRUE(bench.shoot()) << "it can be started again";
}

}  // namespace
}  // namespace plumbline::commands
