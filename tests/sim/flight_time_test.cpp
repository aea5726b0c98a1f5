// SPDX-License-Identifier: MIT
// From the bytes of a simulated receiver to where the antenna was at an instant of the host's
// clock: decoder, receiver, clock fit and predictor in a row.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "edge/gnss/leap_seconds.h"
#include "edge/gnss/stream_decoder.h"
#include "edge/timing/antenna_predictor.h"
#include "edge/timing/clock_fit.h"
#include "sim/gnss_stream.h"
#include "sim/random.h"
#include "sim/replayed_receiver.h"

namespace plumbline::sim {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr double kFootM = 90;
constexpr double kSpeedMS = 3;
constexpr int kFlights = 100;
constexpr double kLatencySigmaS = 0.030;  // of the default of ClockFitOptions

geodesy::Geodetic climb(double time_s) {
  return {35.6687242, 139.7627572, kFootM + kSpeedMS * time_s};
}

struct Outcome {
  double height_error_m = 0;
  double sigma_m = 0;
  double sigma_without_latency_m = 0;
};

// A receiver whose least latency is drawn from what is assumed of it, a crystal of 50 ppm, and one
// exposure in mid-flight. What is known of it at `look`.
Outcome fly(std::uint64_t seed, HostTime exposure, HostTime look) {
  Random random(seed, 7);
  GnssStreamOptions options;
  const double latency_s = std::max(0.0, 0.080 + kLatencySigmaS * random.normal());
  options.least_latency = std::chrono::nanoseconds(std::llround(1e9 * latency_s));
  options.host_rate_error = 50e-6 * random.normal();
  VirtualClock clock;
  GnssStream stream(climb, options, seed);
  ReplayedReceiver receiver(clock, gnss::make_fix_decoder, [&] { return stream.next(); });
  timing::ClockFit fit;
  timing::AntennaPredictor antenna;
  EXPECT_TRUE(receiver.start([&](const ReceiverEvent& event) {
    const auto* fix = std::get_if<ReceivedFix>(&event);
    if (fix == nullptr || !fix->fix.time) return;
    fit.add(*gnss::gps_of(*fix->fix.time), fix->first_byte);
    antenna.add(fix->fix);
  }));
  clock.run_until(look);
  receiver.stop();
  const auto seen = antenna.at(exposure, *fit.estimate());
  EXPECT_TRUE(seen.has_value());
  if (!seen) return {};
  const double host_s = std::chrono::duration<double>(exposure.time_since_epoch()).count();
  const double true_m = climb(host_s / (1 + options.host_rate_error)).height_ellipsoidal_m;
  const double own_m2 = seen->covariance_enu_m2(2, 2);
  return {seen->position.height_ellipsoidal_m - true_m,
          std::sqrt(own_m2 + std::pow(seen->latency_shift_enu_m.z(), 2)), std::sqrt(own_m2)};
}

// Bounds: three standard deviations of a binomial count; one-sided above, for the fit's sigma is
// wide on purpose. Returns the largest sigma of a height, without what the latency leaves open.
double expect_covered(HostTime exposure, HostTime look) {
  int one = 0, two = 0;
  double largest_m = 0;
  for (int i = 0; i < kFlights; ++i) {
    const Outcome outcome = fly(1000 + static_cast<std::uint64_t>(i), exposure, look);
    one += std::abs(outcome.height_error_m) <= outcome.sigma_m ? 1 : 0;
    two += std::abs(outcome.height_error_m) <= 2 * outcome.sigma_m ? 1 : 0;
    largest_m = std::max(largest_m, outcome.sigma_without_latency_m);
  }
  const auto least = [](double share) {
    return kFlights * share - 3 * std::sqrt(kFlights * share * (1 - share));
  };
  ::testing::Test::RecordProperty("within_one_sigma", one);
  ::testing::Test::RecordProperty("within_two_sigma", two);
  EXPECT_GE(one, least(0.683));
  EXPECT_GE(two, least(0.954));
  return largest_m;
}

TEST(FlightTime, KnowsWhereAPhotoWasTakenAsWellAsItSays) {
  // 30 ms of latency at 3 m/s are 9 cm: the rest must not be more.
  EXPECT_LT(expect_covered(HostTime(seconds(60)), HostTime(seconds(63))),
            kSpeedMS * kLatencySigmaS);
}

TEST(FlightTime, KnowsAheadWhereThePhotoWillBeTakenAsWellAsItSays) {
  expect_covered(HostTime(milliseconds(60300)), HostTime(seconds(60)));
}

}  // namespace
}  // namespace plumbline::sim
