// SPDX-License-Identifier: MIT
// What goes wrong in flight, and what is expected of the daemon then: the table of tests/README.md.
// Every test ends with the flight whole on the disk: nothing stored is lost, nothing is silent, and
// no photo has a wrong position without a mark.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <memory>
#include <set>
#include <string>
#include <vector>

#include "sim/sim_disk.h"
#include "tests/firmware/flight/paced_clock.h"
#include "tests/firmware/flight/recorded_flight.h"
#include "tests/flights/drone.h"

namespace plumbline::flight {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Kind = sim::GnssFault::Kind;

// Up at 2 m/s from second 8 on: at 30 m about second 23, at 90 m about second 53.
flights::DroneOptions climb() {
  flights::DroneOptions options;
  options.path.wait_s = 8;
  options.path.aside_m = 6;
  options.path.descent_m_s = 8;
  options.receiver.fixed_sigma = {0.005, 0.010};
  return options;
}

HostTime at_s(double seconds) {
  return HostTime(std::chrono::nanoseconds(std::llround(1e9 * seconds)));
}

bool has_mark(const capture::PhotoTaken& taken) {
  const capture::Marks& marks = taken.marks;
  return marks.reckoned || marks.no_position || marks.not_fixed || marks.jumped;
}

class FaultInFlight : public testing::Test {
 protected:
  void begin(const flights::DroneOptions& options, SessionOptions plan = {}) {
    drone_ = std::make_unique<flights::Drone>(options);
    plan.threads = false;
    SessionEvents events;
    events.stored = [this](int number, const std::string&) { reported_.push_back(number); };
    const Devices devices{drone_->clock(), disk_, drone_->receiver(), &drone_->camera()};
    session_ = std::make_unique<Session>(plan, devices, events);
    ASSERT_TRUE(session_->start());
  }

  void at(double seconds, std::function<void()> action) {
    drone_->clock().at(at_s(seconds), std::move(action));
  }

  void fly_to_the_end() {
    session_->run(drone_->end());
    session_->finish("switched off");
    flight_ = recorded_flight(disk_, "0001");
    EXPECT_EQ(flight_.summary.state, record::JournalState::kComplete);
    for (const auto& [number, stored] : flight_.stored) {
      EXPECT_TRUE(is_whole(disk_, "0001", stored));
    }
    for (const int number : reported_) EXPECT_TRUE(flight_.stored.contains(number));
    for (const auto& [number, taken] : flight_.taken) {
      EXPECT_TRUE(flight_.stored.contains(number)) << "photo " << number << " was lost";
      check_position(taken);
    }
  }

  double true_height_m(const capture::PhotoTaken& taken) const {
    return drone_->place_m(taken.exposed).z();
  }

  void check_position(const capture::PhotoTaken& taken) const {
    if (!taken.place || has_mark(taken)) return;
    const Eigen::Vector3d truly_m = drone_->place_m(taken.exposed);
    const Eigen::Vector3d sigma_m = taken.place->covariance_m2.diagonal().cwiseSqrt();
    const double off_m = std::abs(taken.place->height_m - truly_m.z());
    EXPECT_LT(off_m, 0.1 + 5 * sigma_m.z()) << "photo " << taken.number << " is unmarked";
    // Positions are about the first fix, which is where the drone stood.
    const Eigen::Vector2d aside_m = (taken.place->in_enu_m - truly_m).head<2>();
    EXPECT_LT(aside_m.norm(), 0.1 + 5 * sigma_m.x()) << "photo " << taken.number << " is unmarked";
  }

  std::set<double> heights_m() const {
    std::set<double> heights_m;
    for (const auto& [number, taken] : flight_.taken) {
      if (taken.target.reason == capture::Reason::kHeight) {
        EXPECT_TRUE(heights_m.insert(taken.target.height_m).second) << taken.target.height_m;
      }
    }
    return heights_m;
  }

  void expect_every_height() const { EXPECT_EQ(heights_m().size(), 13u); }

  // Photos exposed between two times.
  std::vector<capture::PhotoTaken> taken_between(double from_s, double to_s) const {
    std::vector<capture::PhotoTaken> found;
    for (const auto& [number, taken] : flight_.taken) {
      if (taken.exposed >= at_s(from_s) && taken.exposed < at_s(to_s)) found.push_back(taken);
    }
    return found;
  }

  sim::SimDisk disk_;
  std::unique_ptr<flights::Drone> drone_;
  std::unique_ptr<Session> session_;
  std::vector<int> reported_;
  RecordedFlight flight_;
};

// 5 s by the last climb rate: then every 2 s, whatever the height.
TEST_F(FaultInFlight, GoesOnByTheLastClimbRateAndThenByTimeWithoutReceiver) {
  auto options = climb();
  options.receiver.faults = {{30, 44, Kind::kSilent, {}}};
  begin(options);
  fly_to_the_end();
  const auto reckoned = taken_between(31.5, 34.5);
  EXPECT_GE(reckoned.size(), 1u);
  for (const auto& taken : reckoned) {
    EXPECT_TRUE(taken.marks.reckoned);
    EXPECT_EQ(taken.target.reason, capture::Reason::kHeight);
    EXPECT_NEAR(true_height_m(taken), taken.target.height_m, 1.5);
  }
  const auto blind = taken_between(36, 43.5);
  EXPECT_GE(blind.size(), 3u);
  for (std::size_t k = 0; k < blind.size(); ++k) {
    EXPECT_EQ(blind[k].target.reason, capture::Reason::kBlind);
    EXPECT_TRUE(blind[k].marks.no_position);
    if (k == 0) continue;
    EXPECT_NEAR(std::chrono::duration<double>(blind[k].exposed - blind[k - 1].exposed).count(), 2,
                0.15);
  }
  EXPECT_FALSE(sentences(flight_, "receiver").empty());
  expect_every_height();  // those that went by are taken on the way down
}

TEST_F(FaultInFlight, TakesUpAReceiverThatIsPluggedInAgain) {
  auto options = climb();
  options.cable_out = {at_s(30), at_s(33)};
  begin(options);
  fly_to_the_end();
  EXPECT_FALSE(sentences(flight_, "receiver", "pulled out").empty());
  for (const auto& taken : taken_between(31.5, 33)) EXPECT_TRUE(taken.marks.reckoned);
  for (const auto& taken : taken_between(35, 50)) EXPECT_FALSE(has_mark(taken));
  expect_every_height();
}

TEST_F(FaultInFlight, MarksPhotosWithoutAFixedSolution) {
  auto options = climb();
  options.receiver.faults = {{30, 40, Kind::kFloat, {}}};
  begin(options);
  fly_to_the_end();
  const auto marked = taken_between(31, 39.5);
  EXPECT_GE(marked.size(), 3u);
  for (const auto& taken : marked) EXPECT_TRUE(taken.marks.not_fixed);
  expect_every_height();
}

// Nothing but the step tells of it.
TEST_F(FaultInFlight, MarksPhotosFromAFalseFixUntilItIsOver) {
  auto options = climb();
  options.receiver.faults = {{30, 36, Kind::kFalseFix, {3, 0, 2}}};
  begin(options);
  fly_to_the_end();
  const auto marked = taken_between(31, 36);
  EXPECT_GE(marked.size(), 1u);
  for (const auto& taken : marked) EXPECT_TRUE(taken.marks.jumped);
  for (const auto& taken : taken_between(37, 50)) EXPECT_FALSE(taken.marks.jumped);
}

// It does not come back: nobody knows which side of it was right.
TEST_F(FaultInFlight, MarksEveryPhotoAfterAJumpOfAHundredMetres) {
  auto options = climb();
  options.receiver.faults = {{30, 200, Kind::kFalseFix, {100, 0, 0}}};
  begin(options);
  fly_to_the_end();
  EXPECT_FALSE(sentences(flight_, "receiver", "jump").empty());
  for (const auto& taken : taken_between(30.5, 200)) EXPECT_TRUE(taken.marks.jumped);
  expect_every_height();
}

TEST_F(FaultInFlight, DecidesTheSameWhenTheWallClockIsSet) {
  begin(climb());
  at(30, [this] { drone_->clock().step_wall(std::chrono::hours(-3)); });
  at(40, [this] { drone_->clock().step_wall(std::chrono::hours(30)); });
  fly_to_the_end();
  expect_every_height();
  for (const auto& [number, taken] : flight_.taken) EXPECT_FALSE(has_mark(taken)) << number;
}

TEST_F(FaultInFlight, SaysThatTheCameraStalledAndTakesTheHeightsThatWentByLater) {
  begin(climb());
  at(30, [this] { drone_->camera().silence(true); });
  at(36, [this] { drone_->camera().silence(false); });
  fly_to_the_end();
  EXPECT_FALSE(sentences(flight_, "camera", "stopped delivering").empty());
  EXPECT_TRUE(taken_between(30.3, 35.9).empty());
  expect_every_height();
}

TEST_F(FaultInFlight, GoesOnWithACameraThatIsBack) {
  begin(climb());
  at(30, [this] { drone_->camera().unplug(); });
  at(36, [this] { drone_->camera().plug_in(); });
  fly_to_the_end();
  EXPECT_FALSE(sentences(flight_, "camera", "unplugged").empty());
  EXPECT_FALSE(sentences(flight_, "camera", "delivers").empty());
  expect_every_height();
}

TEST_F(FaultInFlight, OpensACameraAnewThatFailed) {
  begin(climb());
  at(30, [this] { drone_->camera().break_stream(); });
  fly_to_the_end();
  EXPECT_FALSE(sentences(flight_, "camera", "failed").empty());
  expect_every_height();
}

// Photos wait in memory, and are stored when there is space again.
TEST_F(FaultInFlight, KeepsWhatAFullDiskRefusesUntilThereIsSpace) {
  begin(climb());
  at(30, [this] { disk_.set_capacity(1000); });
  std::size_t then = 0;
  at(45, [this, &then] {
    then = reported_.size();
    disk_.set_capacity(1u << 30);
  });
  fly_to_the_end();
  EXPECT_FALSE(sentences(flight_, "disk", "full").empty());
  EXPECT_FALSE(sentences(flight_, "disk", "again").empty());
  EXPECT_LT(then, flight_.taken.size());
  EXPECT_EQ(reported_.size(), flight_.taken.size());
  expect_every_height();
}

// The disk is full between 44 and 74 m, and memory holds two photos: those that find no place there
// are lost and said, and on the way down their heights are taken again.
TEST_F(FaultInFlight, TakesAHeightAgainWhosePhotoFoundNoPlaceInMemory) {
  SessionOptions plan;
  plan.recorder.most_waiting_photos = 2;
  begin(climb(), plan);
  at(30, [this] { disk_.set_capacity(1000); });
  at(45, [this] { disk_.set_capacity(1u << 30); });
  session_->run(drone_->end());
  session_->finish("switched off");
  flight_ = recorded_flight(disk_, "0001");
  EXPECT_FALSE(sentences(flight_, "photo", "was lost: too many wait for the disk").empty());
  EXPECT_FALSE(flight_.missed.empty());
  std::set<double> stored_m;
  for (const auto& [number, stored] : flight_.stored) {
    EXPECT_TRUE(is_whole(disk_, "0001", stored));
    const capture::Target& target = flight_.taken.at(number).target;
    if (target.reason == capture::Reason::kHeight) stored_m.insert(target.height_m);
  }
  EXPECT_EQ(stored_m.size(), 13u);
}

// Memory for the journal is soon full: what devices said is lost, and told; what was decided, and
// the names of photos, are not.
TEST_F(FaultInFlight, TellsOfEntriesThatWereLostAndLosesNoNameOfAPhoto) {
  SessionOptions plan;
  plan.recorder.most_waiting_bytes = 20'000;
  begin(climb(), plan);
  at(30, [this] { disk_.set_capacity(1000); });
  at(45, [this] { disk_.set_capacity(1u << 30); });
  fly_to_the_end();
  EXPECT_FALSE(sentences(flight_, "disk", "entries of the journal were lost").empty());
  expect_every_height();
}

TEST_F(FaultInFlight, MakesNoHeapOfFoldersWhileTheDiskIsFull) {
  begin(climb());
  const double landed_s = std::chrono::duration<double>(drone_->end() - HostTime{}).count() - 2;
  at(landed_s, [this] { disk_.set_capacity(1000); });
  session_->run(drone_->end() + seconds(30));
  EXPECT_LE(disk_.list("")->size(), 2u);
}

// Each sync takes 2 s, and each photo four of them: the disk falls behind, on its own thread, and
// comes after.
TEST(SlowDisk, CostsNoPhoto) {
  auto options = climb();
  options.path.top_m = 18;
  flights::Drone drone(options);
  PacedClock clock(drone.clock(), 4);
  sim::SimDisk disk;
  SessionOptions plan;
  plan.capture.plan.heights_m = {10, 12, 14, 16};
  Session session(plan, {clock, disk, drone.receiver(), &drone.camera()}, {});
  ASSERT_TRUE(session.start());
  disk.slow_down(seconds(2), [&clock](auto time) { clock.sleep(time); });
  std::size_t most_waiting = 0;
  while (clock.now() < drone.end()) {
    session.run(clock.now() + milliseconds(200));
    most_waiting = std::max(most_waiting, session.recorder().counts().waiting_photos);
  }
  session.finish("switched off");
  const auto flight = recorded_flight(disk, "0001");
  EXPECT_EQ(flight.summary.state, record::JournalState::kComplete);
  EXPECT_GE(most_waiting, 2u);
  EXPECT_EQ(flight.stored.size(), flight.taken.size());
  std::set<double> heights_m;
  for (const auto& [number, taken] : flight.taken) heights_m.insert(taken.target.height_m);
  for (const double height_m : {10, 12, 14, 16}) EXPECT_TRUE(heights_m.contains(height_m));
  for (const auto& [number, stored] : flight.stored) EXPECT_TRUE(is_whole(disk, "0001", stored));
}

// On a thread of its own, too: no photo comes to wake it.
TEST(SlowDisk, HasTheJournalWithinTwoSecondsWithoutAnyPhoto) {
  flights::Drone drone(climb());
  PacedClock clock(drone.clock(), 4);
  sim::SimDisk disk;
  const SessionOptions usual;
  Session session(usual, {clock, disk, drone.receiver(), &drone.camera()}, {});
  ASSERT_TRUE(session.start());
  session.run(clock.now() + seconds(5));
  const std::uint64_t before = recorded_flight(disk, "0001").summary.entries;
  session.run(clock.now() + seconds(5));
  EXPECT_GT(before, 10u);
  EXPECT_GT(recorded_flight(disk, "0001").summary.entries, before + 10);
}

}  // namespace
}  // namespace plumbline::flight
