// SPDX-License-Identifier: MIT
// Stated times of exposure against true ones: of a camera that marks in each picture when it was
// taken (tests/hil/host/exposure_mark.h), by a clock that can be asked for the time.
//   PLUMBLINE_TEST_CAMERA_CLOCK   the device to ask; it also sets the camera's delay ("delay MS")
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <mutex>
#include <string>
#include <vector>

#include "tests/contract/far_clock.h"
#include "tests/contract/kernel_camera_bench.h"
#include "tests/hil/host/exposure_mark.h"

namespace plumbline::contract {
namespace {

using namespace std::chrono_literals;
using Milliseconds = std::chrono::duration<double, std::milli>;

constexpr std::size_t kFrames = 200;
constexpr int kPeriodMs = 100;  // of the bench's camera

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// A frame, with what its picture says.
struct Seen {
  ExposureTiming stated;
  std::optional<std::uint64_t> true_middle_ns;  // of the far clock
  double brightness = 0;                        // mean grey below the mark
};

Seen seen_in(const Frame& frame) {
  const RawImage& image = *frame.image;
  Seen seen{frame.timing, hil::read_exposure_mark(image.bytes), 0};
  double sum = 0, count = 0;
  for (std::size_t i = image.stride_bytes; i < image.bytes.size(); i += 2, ++count) {
    sum += image.bytes[i];
  }
  seen.brightness = sum / std::max(count, 1.0);
  return seen;
}

struct Errors {
  std::vector<double> in_sigmas;
  double mean_ms = 0, sd_ms = 0, most_ms = 0, rms_sigmas = 0;

  double share_within(double sigmas) const {
    const auto inside = std::count_if(in_sigmas.begin(), in_sigmas.end(),
                                      [=](double error) { return std::abs(error) <= sigmas; });
    return static_cast<double>(inside) / static_cast<double>(in_sigmas.size());
  }
};

Errors errors_of(const std::vector<Seen>& frames, const ClockTie& first, const ClockTie& last) {
  Errors errors;
  double squares = 0;
  const auto count = static_cast<double>(frames.size());
  for (const Seen& seen : frames) {
    const HostTime truth = ours_of(static_cast<std::int64_t>(*seen.true_middle_ns), first, last);
    const double error_ms = Milliseconds(seen.stated.middle_of_row(0) - truth).count();
    const double in_sigmas = error_ms / Milliseconds(seen.stated.sigma).count();
    errors.in_sigmas.push_back(in_sigmas);
    errors.mean_ms += error_ms / count;
    errors.most_ms = std::max(errors.most_ms, std::abs(error_ms));
    errors.rms_sigmas += in_sigmas * in_sigmas / count;
    squares += error_ms * error_ms;
  }
  errors.rms_sigmas = std::sqrt(errors.rms_sigmas);
  errors.sd_ms = std::sqrt(std::max(0.0, squares / count - errors.mean_ms * errors.mean_ms));
  return errors;
}

class ExposureOfThisMachine : public ::testing::Test {
 protected:
  void SetUp() override {
    const std::string clock = setting("PLUMBLINE_TEST_CAMERA_CLOCK");
    if (clock.empty()) {
      GTEST_SKIP() << "no camera that marks its exposures: PLUMBLINE_TEST_CAMERA_CLOCK is not set "
                      "(scripts/bench sets it)";
    }
    far_ = std::make_unique<FarClock>(clock);
    ASSERT_TRUE(far_->is_open()) << "cannot open " << clock;
    bench_ = make_kernel_camera_bench(setting("PLUMBLINE_TEST_CAMERA"));
    camera_ = bench_->camera();
  }
  void TearDown() override {
    if (!bench_) return;
    camera_.reset();
    far_->say("delay 0");
  }

  void start(const CameraOptions& options) {
    const Status started = camera_->start(options, [this](const CameraEvent& event) {
      const Frame* frame = std::get_if<Frame>(&event);
      if (frame == nullptr) return;
      const Seen seen = seen_in(*frame);
      const std::lock_guard lock(mutex_);
      seen_.push_back(seen);
    });
    ASSERT_TRUE(started) << started.error().sentence;
  }

  std::vector<Seen> seen() const {
    const std::lock_guard lock(mutex_);
    return seen_;
  }

  // The next so many frames, or as many as come in a minute.
  std::vector<Seen> next(std::size_t count) {
    const std::size_t before = seen().size();
    for (int i = 0; i < 6000 && seen().size() < before + count; ++i) bench_->pass(10ms);
    std::vector<Seen> all = seen();
    return {all.begin() + static_cast<std::ptrdiff_t>(before), all.end()};
  }

  // Takes frames of a camera whose delay is anything up to a period, and says how far off the
  // stated middles are.
  void measure(const CameraOptions& options, Errors& errors) {
    far_->say("delay " + std::to_string(kPeriodMs));
    const auto first = far_->tie();
    ASSERT_NO_FATAL_FAILURE(start(options));
    const std::vector<Seen> frames = next(kFrames);
    camera_->stop();
    const auto last = far_->tie();
    ASSERT_TRUE(first && last) << "the far clock does not answer";
    ASSERT_GE(frames.size(), kFrames);
    for (const Seen& frame : frames) ASSERT_TRUE(frame.true_middle_ns) << "a picture has no mark";
    errors = errors_of(frames, *first, *last);
    std::printf("clocks tied to %.3f and %.3f ms\n", Milliseconds(first->doubt).count(),
                Milliseconds(last->doubt).count());
    std::printf("stated minus true middle: mean %.1f ms, sd %.1f ms, largest %.1f ms\n",
                errors.mean_ms, errors.sd_ms, errors.most_ms);
    std::printf("stated sigma %.1f ms; within one %.0f %%, within two %.0f %%; RMS %.2f sigma\n",
                Milliseconds(frames.back().stated.sigma).count(), 100 * errors.share_within(1),
                100 * errors.share_within(2), errors.rms_sigmas);
  }

  double brightness() {
    next(3);  // exposed before
    const std::vector<Seen> frames = next(3);
    return frames.empty() ? 0 : frames.back().brightness;
  }

  std::unique_ptr<FarClock> far_;
  std::unique_ptr<CameraBench> bench_;
  std::unique_ptr<Camera> camera_;
  mutable std::mutex mutex_;
  std::vector<Seen> seen_;
};

// The model's unknown is the delay; the camera makes it what the model takes it to be.
TEST_F(ExposureOfThisMachine, IsStatedWithASigmaThatItsErrorsHave) {
  CameraOptions options = bench_->options();
  options.row_time = 0ns;
  Errors errors;
  ASSERT_NO_FATAL_FAILURE(measure(options, errors));
  EXPECT_GE(errors.share_within(2), 0.95);
  EXPECT_GE(errors.rms_sigmas, 0.8);
  EXPECT_LE(errors.rms_sigmas, 1.2);
}

// Unless it is told, the driver cannot know that the shutter is a global one: of all readout times
// that it allows for, this camera's is the least, in every frame.
TEST_F(ExposureOfThisMachine, IsWithinWhatIsStatedWhereTheShutterIsNotKnown) {
  Errors errors;
  ASSERT_NO_FATAL_FAILURE(measure(bench_->options(), errors));
  EXPECT_EQ(errors.share_within(3), 1.0);
}

TEST_F(ExposureOfThisMachine, DarkensThePictureWhenItIsLimitedAndGainLightensIt) {
  CameraOptions options = bench_->options();
  options.longest_exposure = 2000us;
  options.fixed_gain = 10;
  ASSERT_NO_FATAL_FAILURE(start(options));
  const double usual = brightness();
  camera_->limit_exposure(1000us);
  const double darker = brightness();
  camera_->stop();
  options.longest_exposure = 1000us;
  options.fixed_gain = 20;
  ASSERT_NO_FATAL_FAILURE(start(options));
  const double as_before = brightness();
  std::printf("mean grey %.1f, at half the exposure %.1f, at twice the gain %.1f\n", usual, darker,
              as_before);
  EXPECT_NEAR(darker / usual, 0.5, 0.05);
  EXPECT_NEAR(as_before / usual, 1.0, 0.1);
}

}  // namespace
}  // namespace plumbline::contract
