// SPDX-License-Identifier: MIT
// A photo at every height, over random flights with a pulse per second (without one the receiver's
// unknown latency moves all photos of a flight alike): none twice, none missed, and how far the
// altitude of exposure is from its step.
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

// By rate of fixes and whether the pilot bobs.
std::map<std::string, Tally> fly_all(Release release) {
  std::map<std::string, Tally> tallies;
  for (int k = 0; k < kFlights; ++k) {
    const auto flight = random_flight(static_cast<std::uint64_t>(9000 + k), release);
    const auto log = flights::fly(flight);
    char name[80];
    std::snprintf(name, sizeof name, "%g m/s, %2d Hz%s", flight.path.climb_m_s,
                  static_cast<int>(1000 / flight.receiver.interval.count()),
                  flight.path.bobs_per_s > 0 ? ", bobbing" : "");
    count(log, allowed_m(flight), tallies[name]);
  }
  return tallies;
}

// Judged: fixes of 5 Hz and more, steady climbs. The rest is told. Of a few flights the RMS says
// nothing: where five metres take a whole number of frames, all photos of a flight share an error.
void expect_every_step(Release release) {
  for (const auto& [name, t] : fly_all(release)) {
    std::printf(
        "%-22s %5d photos, RMS %.2f of what is allowed, largest %.2f m, late %d, missed %d\n",
        name.c_str(), t.photos, t.rms(), t.largest_m, t.late, t.missed);
    EXPECT_EQ(t.missed, 0) << name;
    const bool often =
        name.find(" 5 Hz") != std::string::npos || name.find("10 Hz") != std::string::npos;
    const bool steady = name.find("bobbing") == std::string::npos;
    if (often && steady && !PLUMBLINE_SANITIZED) {
      EXPECT_LE(t.rms(), 1) << name;
    }
  }
}

TEST(RandomFlights, PhotographEachStepOnceByAPulsedCamera) { expect_every_step(Release::kPulse); }

TEST(RandomFlights, PhotographEachStepOnceByACameraThatRunsFreely) {
  expect_every_step(Release::kNearestFrame);
}

}  // namespace
}  // namespace plumbline::capture
