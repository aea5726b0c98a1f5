// SPDX-License-Identifier: MIT
#include "firmware/ingest/flight_journal.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "edge/geodesy/local_frame.h"
#include "tests/flights/capture_flight.h"

namespace plumbline::ingest {
namespace {

FlightJournal journal_of(const flights::CaptureLog& log) {
  FlightJournal journal;
  journal.entries.emplace_back(record::Began{});
  journal.entries.insert(journal.entries.end(), log.inputs.begin(), log.inputs.end());
  // Where a decision stands among the inputs does not matter here, but that it is before them does.
  journal.entries.insert(journal.entries.begin() + 1, log.decisions.begin(), log.decisions.end());
  return journal;
}

std::vector<std::string> names_of(const flights::CaptureLog& log) {
  std::vector<std::string> names;
  for (const auto& photo : log.photos) {
    char name[16];
    std::snprintf(name, sizeof name, "%04d.jpg", photo.taken.number);
    names.emplace_back(name);
  }
  return names;
}

struct Share {
  int one = 0, two = 0, all = 0;

  void add(double off_m, double sigma_m) {
    ++all;
    one += std::abs(off_m) <= sigma_m ? 1 : 0;
    two += std::abs(off_m) <= 2 * sigma_m ? 1 : 0;
  }
};

// Heights of the antenna at the exposures of 40 flights, beside the truth and the stated sigma.
TEST(FlightJournal, KnowsWhereEachPhotoWasTakenAsWellAsItSays) {
  Share share;
  double squares_m2 = 0;
  for (std::uint64_t seed = 500; seed < 540; ++seed) {
    flights::CaptureFlight flight;
    flight.seed = seed;
    flight.path.climb_m_s = 3;
    flight.receiver.fixed_sigma = {0.005, 0.010};
    const auto log = flights::fly(flight);
    const std::vector<std::string> names = names_of(log);
    const auto antenna = antenna_of_flight(journal_of(log), names, flight.options);
    EXPECT_LT(antenna.common_time_sigma_s, 1e-4) << "pulses know the latency";
    ASSERT_EQ(antenna.photos.size(), log.photos.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      ASSERT_TRUE(antenna.photos[k]) << names[k];
      const double off_m =
          antenna.photos[k]->position.height_ellipsoidal_m - 52.3 - log.photos[k].place_m.z();
      share.add(off_m, std::sqrt(antenna.photos[k]->covariance_enu_m2(2, 2)));
      squares_m2 += off_m * off_m;
    }
  }
  RecordProperty("within_one_sigma_percent", 100 * share.one / share.all);
  RecordProperty("rms_mm", static_cast<int>(1000 * std::sqrt(squares_m2 / share.all)));
  EXPECT_GE(share.one, 0.60 * share.all);
  EXPECT_GE(share.two, 0.92 * share.all);
  EXPECT_LT(std::sqrt(squares_m2 / share.all), 0.02);  // two sigmas of one epoch, interpolated
}

// Without pulses, and a receiver that is slower than it is taken for, by 40 ms and the 64 bytes
// that a read waits for: all photos are off by that times their velocity, and by no more than they
// say besides.
TEST(FlightJournal, LeavesTheLatencyOfTheReceiverToBeOneErrorOfAllPhotos) {
  constexpr double kSlower_s = 0.04 + 64 * 10 / 115200.0;
  Share apart, together;
  for (std::uint64_t seed = 700; seed < 720; ++seed) {
    flights::CaptureFlight flight;
    flight.seed = seed;
    flight.path.climb_m_s = 3;
    flight.pulses_per_second = false;
    flight.receiver.fixed_sigma = {0.005, 0.010};
    flight.options.receiver_latency.sigma = std::chrono::milliseconds(30);
    flight.receiver.least_latency =
        flight.options.receiver_latency.value + std::chrono::milliseconds(40);
    const auto log = flights::fly(flight);
    const auto antenna = antenna_of_flight(journal_of(log), names_of(log), flight.options);
    EXPECT_NEAR(antenna.common_time_sigma_s, 0.03, 0.001);
    ASSERT_EQ(antenna.photos.size(), log.photos.size());
    for (std::size_t k = 0; k < log.photos.size(); ++k) {
      const auto& at = antenna.photos[k];
      ASSERT_TRUE(at && at->velocity_enu_m_s);
      const double off_m = at->position.height_ellipsoidal_m - 52.3 - log.photos[k].place_m.z();
      const double sigma_m = std::sqrt(at->covariance_enu_m2(2, 2));
      apart.add(off_m, sigma_m);
      together.add(off_m + kSlower_s * at->velocity_enu_m_s->z(), sigma_m);
    }
  }
  EXPECT_LT(apart.two, 0.5 * apart.all);
  EXPECT_GE(together.one, 0.60 * together.all);
  EXPECT_GE(together.two, 0.92 * together.all);
}

record::Entry photo_at(int number, std::chrono::milliseconds exposed) {
  capture::PhotoTaken taken;
  taken.number = number;
  taken.exposed = HostTime(exposed);
  return capture::Decision{HostTime(exposed), taken};
}

record::Entry attitude_at(std::chrono::milliseconds arrival, double yaw_rad) {
  PilotAttitude attitude;
  attitude.arrival = HostTime(arrival);
  attitude.yaw_rad = yaw_rad;
  return attitude;
}

TEST(FlightJournal, KnowsTheHeadingThatTheAutopilotToldNextToEachPhoto) {
  using std::chrono::milliseconds;
  FlightJournal journal;
  // The second run is of another boot: its times compare with its own only.
  journal.entries = {record::Began{},
                     attitude_at(milliseconds(1000), 0.1),
                     attitude_at(milliseconds(1500), 0.2),
                     photo_at(1, milliseconds(1400)),
                     attitude_at(milliseconds(2000), 0.3),
                     photo_at(2, milliseconds(3500)),
                     record::Began{},
                     photo_at(3, milliseconds(1020)),
                     attitude_at(milliseconds(1100), -2.5)};
  const auto headings =
      headings_of_flight(journal, {"0001.jpg", "0002.jpg", "0003.jpg", "0004.jpg"});
  ASSERT_EQ(headings.size(), 4u);
  EXPECT_EQ(headings[0], 0.2);
  EXPECT_FALSE(headings[1]) << "a second and a half away";
  EXPECT_EQ(headings[2], -2.5);
  EXPECT_FALSE(headings[3]);
}

TEST(FlightJournal, SaysWhichPhotoHasNoPosition) {
  const auto antenna = antenna_of_flight({}, {"0001.jpg"}, {});
  ASSERT_EQ(antenna.photos.size(), 1u);
  EXPECT_FALSE(antenna.photos[0]);
  EXPECT_EQ(antenna.warnings.size(), 1u);
}

}  // namespace
}  // namespace plumbline::ingest
