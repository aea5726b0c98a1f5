// SPDX-License-Identifier: MIT
// A photo at every height, over random flights: none twice, none missed, and how far the altitude
// of exposure is from its step. Half of them have a pulse per second; the others know the
// receiver's least latency, as whoever has measured it does (what is not known of it moves all
// photos of a flight alike, by that time at the climb's speed).
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <map>
#include <string>

#include "sim/random.h"
#include "tests/flights/capture_flight.h"

namespace plumbline::capture {
namespace {

using std::chrono::milliseconds;

// A thousand flights in all; fewer where sanitizers make each twenty times as long.
constexpr int kFlights = PLUMBLINE_SANITIZED ? 25 : 500;

flights::CaptureFlight random_flight(std::uint64_t seed, Release release) {
  sim::Random random(seed, 51);
  const auto one_of = [&random](std::initializer_list<double> values) {
    return values.begin()[static_cast<int>(random.uniform() * static_cast<double>(values.size()))];
  };
  flights::CaptureFlight flight;
  flight.seed = seed;
  flight.path.climb_m_s = one_of({1, 2, 3, 5});
  flight.path.bobs_per_s = one_of({0, 0.05});
  flight.receiver.interval = milliseconds(static_cast<int>(1000 / one_of({1, 2, 5, 10})));
  flight.receiver.fixed_sigma = {0.005, 0.010};
  flight.receiver.least_latency =
      std::chrono::microseconds(std::llround(random.uniform(50e3, 200e3)));
  flight.receiver.latency_jitter = milliseconds(10);
  flight.receiver.host_rate_error = 30e-6 * random.normal();
  flight.options.release.release = release;
  flight.camera_delay_s = random.uniform(0.020, 0.300);
  flight.frames_per_s = one_of({5, 10, 20, 30});
  flight.pulses_per_second = random.uniform() < 0.5;
  if (!flight.pulses_per_second) {
    flight.options.receiver_latency = {flight.receiver.least_latency, milliseconds(30)};
  }
  return flight;
}

struct Tally {
  int photos = 0;
  double squares = 0;  // of the altitude's error over what is allowed for it
  double largest_m = 0;
  int missed = 0;
  int late = 0;
  double rms() const { return std::sqrt(squares / photos); }
};

void count(const flights::CaptureLog& log, double allowed_m, Tally& tally) {
  std::map<int, int> taken;
  for (const auto& photo : log.photos) {
    if (photo.taken.target.reason != Reason::kHeight) continue;
    EXPECT_EQ(++taken[photo.taken.target.entry], 1);
    const double off_m = photo.place_m.z() - photo.taken.target.height_m;
    ++tally.photos;
    tally.squares += std::pow(off_m / allowed_m, 2);
    tally.largest_m = std::max(tally.largest_m, std::abs(off_m));
    tally.late += photo.taken.marks.late ? 1 : 0;
  }
  for (const bool entry : log.entries_taken) tally.missed += entry ? 0 : 1;
}

// What the altitude of exposure may be off, RMS: of a pulsed camera by speed; of one that runs
// freely half a period of it besides, evenly spread.
double allowed_m(const flights::CaptureFlight& flight) {
  const double speed_m_s = flight.path.climb_m_s;
  const double aim_m = speed_m_s > 3 ? 0.08 : 0.05;
  if (flight.options.release.release == Release::kPulse) return aim_m;
  return std::hypot(0.05, speed_m_s / flight.frames_per_s / std::sqrt(12));
}

struct Tallies {
  std::map<std::string, Tally> kinds;  // by speed, rate of fixes, clock, and whether the pilot bobs
  std::map<std::string, Tally> judged;
  std::map<std::string, Tally> told;
};

Tallies fly_all(Release release) {
  Tallies tallies;
  for (int k = 0; k < kFlights; ++k) {
    const auto flight = random_flight(static_cast<std::uint64_t>(9000 + k), release);
    const auto log = flights::fly(flight);
    const bool bobs = flight.path.bobs_per_s > 0;
    char name[80];
    std::snprintf(name, sizeof name, "%g m/s, %2d Hz, %s%s", flight.path.climb_m_s,
                  static_cast<int>(1000 / flight.receiver.interval.count()),
                  flight.pulses_per_second ? "pulses" : "arrivals", bobs ? ", bobbing" : "");
    count(log, allowed_m(flight), tallies.kinds[name]);
    if (flight.receiver.interval > milliseconds(200)) continue;
    const std::string speed = flight.path.climb_m_s > 3 ? "5 m/s" : "up to 3 m/s";
    count(log, allowed_m(flight), (bobs ? tallies.told : tallies.judged)[speed + ", from 5 Hz"]);
  }
  return tallies;
}

void tell(const std::string& name, const Tally& t) {
  std::printf("%-34s %5d photos, RMS %.2f of what is allowed, largest %.2f m, late %d, missed %d\n",
              name.c_str(), t.photos, t.rms(), t.largest_m, t.late, t.missed);
}

// Judged: fixes of 5 Hz and more, steady climbs. The rest is told: nothing foresees that a pilot
// will turn back. Of the few flights of a kind the RMS says little: where five metres take a whole
// number of frames, all photos of a flight share an error.
void expect_every_step(Release release) {
  const Tallies tallies = fly_all(release);
  for (const auto& [name, tally] : tallies.kinds) {
    tell(name, tally);
    EXPECT_EQ(tally.missed, 0) << name;
  }
  for (const auto& [name, tally] : tallies.told) tell("all bobbing, " + name, tally);
  for (const auto& [name, tally] : tallies.judged) {
    tell("all steady, " + name, tally);
    if (!PLUMBLINE_SANITIZED) {
      EXPECT_LE(tally.rms(), 1) << name;
    }
  }
}

TEST(RandomFlights, PhotographEachStepOnceByAPulsedCamera) { expect_every_step(Release::kPulse); }

TEST(RandomFlights, PhotographEachStepOnceByACameraThatRunsFreely) {
  expect_every_step(Release::kNearestFrame);
}

}  // namespace
}  // namespace plumbline::capture
