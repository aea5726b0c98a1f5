// SPDX-License-Identifier: MIT
#include "firmware/service/advice/flown_photos.h"

#include <gtest/gtest.h>

#include <chrono>
#include <memory>
#include <optional>

#include "firmware/flight/session.h"
#include "sim/random.h"
#include "sim/sim_disk.h"
#include "tests/flights/drone.h"

namespace plumbline::service {
namespace {

using std::chrono::seconds;

// A climb of three heights whose program is killed in the air, and started again.
class FlightInterrupted : public testing::Test {
 protected:
  FlightInterrupted() : drone_(small()) {
    options_.capture.plan.heights_m = {10, 13, 16};
    options_.threads = false;
  }

  static flights::DroneOptions small() {
    flights::DroneOptions options;
    options.path.wait_s = 6;
    options.path.top_m = 18;
    options.path.aside_m = 0;
    options.path.climb_m_s = 1;
    options.path.sideways_m_s = 0.5;
    options.receiver.fixed_sigma = {0.005, 0.010};
    options.camera.frames_per_s = 5;
    return options;
  }

  // Until so many photos are stored; the program then ends without a word.
  void run(sim::SimDisk& disk, int photos) {
    int stored = 0;
    flight::SessionEvents events;
    flight::Session* running = nullptr;
    events.stored = [&](int, const std::string&) {
      if (++stored == photos) running->stop();
    };
    events.decided = [&](const capture::Decision& decision) {
      const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what);
      if (taken == nullptr) return;
      flown_.push_back(*flown_photo(*taken, running->loop().decider().navigator().frame()));
      truly_m_.push_back(drone_.place_m(taken->exposed));
    };
    flight::Session session(options_, {drone_.clock(), disk, drone_.receiver(), &drone_.camera()},
                            events);
    running = &session;
    ASSERT_TRUE(session.start());
    session.run(drone_.end());
  }

  flights::Drone drone_;
  flight::SessionOptions options_;
  std::vector<FlownPhoto> flown_;
  std::vector<Eigen::Vector3d> truly_m_;
};

TEST_F(FlightInterrupted, IsKnownByItsJournal) {
  sim::SimDisk disk;
  run(disk, 2);
  ASSERT_EQ(flown_.size(), 2u);
  const auto before = photos_before(disk, "0001", options_.capture);
  ASSERT_EQ(before.size(), 2u);
  for (std::size_t k = 0; k < before.size(); ++k) {
    EXPECT_EQ(before[k].target.entry, static_cast<int>(k));
    EXPECT_EQ(before[k].height_m, flown_[k].height_m);
    EXPECT_EQ(before[k].covariance_m2, flown_[k].covariance_m2);
    EXPECT_EQ(before[k].place.latitude_deg, flown_[k].place.latitude_deg);
    EXPECT_EQ(before[k].place.longitude_deg, flown_[k].place.longitude_deg);
  }
}

// Each run gives its places about its own first position.
TEST_F(FlightInterrupted, HasItsPhotosInOneFrame) {
  sim::SimDisk disk;
  run(disk, 2);
  run(disk, 1);
  const auto photos = photos_before(disk, "0001", options_.capture);
  ASSERT_EQ(photos.size(), 3u);
  const plan::Flight flight = flight_of(photos, {}, 0);
  for (std::size_t k = 0; k < photos.size(); ++k) {
    const Eigen::Vector3d off_m = flight.taken_m[k] - flight.taken_m[2];
    const Eigen::Vector3d truly_off_m = truly_m_[k] - truly_m_[2];
    EXPECT_LT((off_m - truly_off_m).head<2>().norm(), 0.1) << k;
    EXPECT_NEAR(flight.taken_m[k].z(), truly_m_[k].z(), 0.25) << k;  // 30 ms of latency
  }
}

TEST_F(FlightInterrupted, HasNoPhotoThatNeverReachedTheDisk) {
  sim::SimDisk disk;
  run(disk, 2);
  ASSERT_TRUE(disk.remove("0001/photos/0002.jpg"));
  const auto before = photos_before(disk, "0001", options_.capture);
  ASSERT_EQ(before.size(), 1u);
  EXPECT_EQ(before[0].target.entry, 0);
}

TEST_F(FlightInterrupted, IsNoneWhereNothingIsRecorded) {
  sim::SimDisk disk;
  EXPECT_TRUE(photos_before(disk, "0001", options_.capture).empty());
}

}  // namespace
}  // namespace plumbline::service
