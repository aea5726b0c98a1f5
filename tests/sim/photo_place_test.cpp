// SPDX-License-Identifier: MIT
// All that knows of time in a row: a simulated receiver's bytes, clock fit and predictor foresee
// when a height is reached, the frame ring chooses the frame of a free-running camera, and the
// place of that photo is held against the truth at the true middle of its exposure.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <numbers>
#include <optional>

#include "edge/capture/frame_ring.h"
#include "edge/gnss/leap_seconds.h"
#include "edge/gnss/stream_decoder.h"
#include "edge/timing/antenna_predictor.h"
#include "edge/timing/clock_fit.h"
#include "sim/gnss_stream.h"
#include "sim/random.h"
#include "sim/replayed_receiver.h"
#include "sim/sim_camera.h"

namespace plumbline::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr double kFoot_m = 90;
constexpr double kLatencySigma_s = 0.030;  // of the default of ClockFitOptions
constexpr int kRows = 480;

// 1.4 to 4.6 m/s upwards, and sideways in the wind.
geodesy::Geodetic climb(double time_s) {
  const double swing = std::sin(2 * std::numbers::pi * time_s / 20);
  return {35.6687242, 139.7627572 + 1e-6 * time_s, kFoot_m + 3 * time_s - 5 * swing};
}

GnssStreamOptions receiver_options(Random& random) {
  GnssStreamOptions options;
  const double latency_s = std::max(0.0, 0.080 + kLatencySigma_s * random.normal());
  options.least_latency = nanoseconds(std::llround(1e9 * latency_s));
  options.host_rate_error = 50e-6 * random.normal();
  return options;
}

// Rows of 60 us: a rolling shutter of 29 ms. Stamps that are off by a millisecond, and say so.
SimCameraOptions camera_options(unsigned seed) {
  SimCameraOptions options;
  options.width_px = 4;
  options.height_px = kRows;
  options.row_time = std::chrono::microseconds(60);
  options.sigma_interval = milliseconds(3);
  options.sigma_stamp = milliseconds(1);
  options.drop_probability = 0.02;
  options.seed = seed;
  return options;
}

struct Shot {
  ExposureTiming stated;
  HostTime true_middle;
};

struct Photo {
  double height_off_m = 0;  // of the place that is stated for it
  double height_sigma_m = 0;
  double east_off_m = 0;
  double east_sigma_m = 0;
  double step_off_m = 0;  // of the photo, from the height that was wanted
};

// A flight with one photo.
class Flight {
 public:
  explicit Flight(std::uint64_t seed)
      : random_(seed, 17),
        receiver_options_(receiver_options(random_)),
        wanted_m_(kFoot_m + random_.uniform(90, 150)),
        stream_(climb, receiver_options_, seed),
        receiver_(clock_, gnss::make_fix_decoder, [this] { return stream_.next(); }),
        camera_(clock_, with_picture(camera_options(static_cast<unsigned>(seed)))) {}

  std::optional<Photo> fly() {
    const Status seeing = camera_.start({}, [this](CameraEvent event) { take(event); });
    const Status hearing = receiver_.start([this](const ReceiverEvent& event) { take(event); });
    if (!seeing || !hearing) return std::nullopt;
    while (!shot_ && clock_.now() < HostTime(seconds(80))) run_for(milliseconds(100));
    run_for(seconds(1));  // what comes after the photo tells more of its place
    receiver_.stop();
    camera_.stop();
    return shot_ ? judged() : std::nullopt;
  }

 private:
  SimCameraOptions with_picture(SimCameraOptions options) {
    options.picture = [this](const ExposureTiming& exact) {
      exact_middle_ = exact.middle_of_row(0.5 * (kRows - 1));
      return Image{4, kRows, 1, std::vector<std::uint8_t>(std::size_t{4} * kRows)};
    };
    return options;
  }

  void take(const ReceiverEvent& event) {
    const auto* received = std::get_if<ReceivedFix>(&event);
    if (received == nullptr || !received->fix.time) return;
    const GpsTime epoch = *gnss::gps_of(*received->fix.time);
    fit_.add(epoch, received->first_byte);
    antenna_.add(received->fix);
    if (wished_ || !fit_.estimate()) return;
    const auto now = antenna_.at(epoch);
    if (!now) return;
    const double until_s =
        (wanted_m_ - now->position.height_ellipsoidal_m) / now->velocity_enu_m_s.z();
    if (!(until_s >= 0 && until_s <= 0.45)) return;
    wished_ = true;
    const auto until = nanoseconds(std::llround(1e9 * until_s));
    ring_.want(fit_.estimate()->host_of(epoch + until).time);
  }

  void take(CameraEvent& event) {
    const auto* frame = std::get_if<Frame>(&event);
    if (frame == nullptr) return;
    const HostTime middle = frame->timing.middle_of_row(0.5 * (kRows - 1));
    ring_.push({middle, milliseconds(100)}, {frame->timing, exact_middle_});
    if (auto taken = ring_.take(clock_.now())) shot_ = taken->second;
  }

  void run_for(nanoseconds time) { clock_.run_until(clock_.now() + time); }

  std::optional<Photo> judged() const {
    const auto place =
        antenna_.at(shot_->stated.middle_of_row(0.5 * (kRows - 1)), *fit_.estimate());
    if (!place) return std::nullopt;
    const Eigen::Vector3d blur_m = place->velocity_enu_m_s * in_seconds(shot_->stated.sigma);
    const double host_s =
        std::chrono::duration<double>(shot_->true_middle.time_since_epoch()).count();
    const geodesy::Geodetic truth = climb(host_s / (1 + receiver_options_.host_rate_error));
    const auto frame = geodesy::LocalFrame::at(truth);
    const Eigen::Vector3d off_m = frame->enu_of(place->position);
    const Eigen::Matrix3d all_m2 =
        place->covariance_enu_m2 + blur_m * blur_m.transpose() +
        place->latency_shift_enu_m * place->latency_shift_enu_m.transpose();
    return Photo{off_m.z(), std::sqrt(all_m2(2, 2)), off_m.x(), std::sqrt(all_m2(0, 0)),
                 truth.height_ellipsoidal_m - wanted_m_};
  }

  Random random_;
  GnssStreamOptions receiver_options_;
  double wanted_m_;
  VirtualClock clock_;
  GnssStream stream_;
  ReplayedReceiver receiver_;
  SimCamera camera_;
  timing::ClockFit fit_;
  timing::AntennaPredictor antenna_;
  capture::FrameRing<Shot> ring_{2};
  bool wished_ = false;
  HostTime exact_middle_;
  std::optional<Shot> shot_;
};

struct Tally {
  int count = 0;
  int within_one = 0;
  int within_two = 0;
  double sum2_m2 = 0;
  double sum_sigma_m = 0;

  void add(double off_m, double sigma_m) {
    ++count;
    within_one += std::abs(off_m) <= sigma_m ? 1 : 0;
    within_two += std::abs(off_m) <= 2 * sigma_m ? 1 : 0;
    sum2_m2 += off_m * off_m;
    sum_sigma_m += sigma_m;
  }
  void print(const char* what) const {
    std::printf("%-7s rms %.4f m, mean sigma %.4f m, within 1, 2 sigma %d, %d of %d\n", what,
                std::sqrt(sum2_m2 / count), sum_sigma_m / count, within_one, within_two, count);
  }
  // 68.3 and 95.4 % less three binomial sigmas; no bound above, for the clock's sigma is wide on
  // purpose.
  void expect_covered() const {
    EXPECT_GE(within_one, 0.683 * count - 3 * std::sqrt(0.683 * 0.317 * count));
    EXPECT_GE(within_two, 0.954 * count - 3 * std::sqrt(0.954 * 0.046 * count));
  }
};

TEST(PhotoPlace, IsWhereTheAntennaWasInTheMiddleOfTheExposureAsWellAsItSays) {
  constexpr int kFlights = 100;
  Tally height;
  Tally east;
  double step2_m2 = 0;
  for (int i = 0; i < kFlights; ++i) {
    const auto photo = Flight(2000 + static_cast<std::uint64_t>(i)).fly();
    ASSERT_TRUE(photo) << "flight " << i;
    height.add(photo->height_off_m, photo->height_sigma_m);
    east.add(photo->east_off_m, photo->east_sigma_m);
    step2_m2 += photo->step_off_m * photo->step_off_m;
  }
  height.print("height");
  east.print("east");
  std::printf("beside the step: rms %.4f m\n", std::sqrt(step2_m2 / kFlights));
  height.expect_covered();
  east.expect_covered();
}

}  // namespace
}  // namespace plumbline::sim
