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

struct Share {
  int one = 0, two = 0, all = 0;
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
    std::vector<std::string> names;
    for (const auto& photo : log.photos) {
      char name[16];
      std::snprintf(name, sizeof name, "%04d.jpg", photo.taken.number);
      names.emplace_back(name);
    }
    const auto antenna = antenna_of_flight(journal_of(log), names, flight.options);
    ASSERT_EQ(antenna.photos.size(), log.photos.size());
    for (std::size_t k = 0; k < names.size(); ++k) {
      ASSERT_TRUE(antenna.photos[k]) << names[k];
      const double off_m =
          antenna.photos[k]->position.height_ellipsoidal_m - 52.3 - log.photos[k].place_m.z();
      const double sigma_m = std::sqrt(antenna.photos[k]->covariance_enu_m2(2, 2));
      ++share.all;
      share.one += std::abs(off_m) <= sigma_m ? 1 : 0;
      share.two += std::abs(off_m) <= 2 * sigma_m ? 1 : 0;
      squares_m2 += off_m * off_m;
    }
  }
  RecordProperty("within_one_sigma_percent", 100 * share.one / share.all);
  RecordProperty("rms_mm", static_cast<int>(1000 * std::sqrt(squares_m2 / share.all)));
  EXPECT_GE(share.one, 0.60 * share.all);
  EXPECT_GE(share.two, 0.92 * share.all);
  EXPECT_LT(std::sqrt(squares_m2 / share.all), 0.02);  // two sigmas of one epoch, interpolated
}

TEST(FlightJournal, SaysWhichPhotoHasNoPosition) {
  const auto antenna = antenna_of_flight({}, {"0001.jpg"}, {});
  ASSERT_EQ(antenna.photos.size(), 1u);
  EXPECT_FALSE(antenna.photos[0]);
  EXPECT_EQ(antenna.warnings.size(), 1u);
}

}  // namespace
}  // namespace plumbline::ingest
