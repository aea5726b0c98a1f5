// SPDX-License-Identifier: MIT
// The battery is pulled in the middle of a flight, and put back. What was reported as stored is
// there, and the flight goes on. The drone flies on meanwhile, and the disk keeps of unsynced data
// whatever it likes (sim/sim_disk.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include "sim/random.h"
#include "sim/sim_disk.h"
#include "tests/firmware/flight/recorded_flight.h"
#include "tests/flights/drone.h"

namespace plumbline::flight {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr int kMoments = PLUMBLINE_SANITIZED ? 100 : 2000;  // some ten times slower there

constexpr double kHeights_m[] = {10, 13, 16};
// From power on to the first decisions: fixes for a clock, a camera that streams; and where the
// take-off was not recorded any more, two seconds above the ground that was.
constexpr seconds kSettled{5};

flights::DroneOptions small_flight() {
  flights::DroneOptions options;
  options.path.wait_s = 6;
  options.path.top_m = 18;
  options.path.aside_m = 6;
  options.path.landed_s = 7;
  options.receiver.fixed_sigma = {0.005, 0.010};
  options.camera.frames_per_s = 5;
  return options;
}

SessionOptions small_plan() {
  SessionOptions options;
  options.capture.plan.heights_m.assign(std::begin(kHeights_m), std::end(kHeights_m));
  options.threads = false;
  return options;
}

// When power goes: at a time, or with an operation of the disk after it.
struct Cut {
  HostTime after;
  std::optional<std::uint64_t> operation;  // of those to come
  std::uint64_t seed = 1;                  // of what the disk keeps
  nanoseconds off = seconds(2);
};

class CutFlight {
 public:
  explicit CutFlight(const Cut& cut)
      : cut_(cut), random_(cut.seed, 71), drone_(small_flight()), disk_(new sim::SimDisk) {}

  void fly() {
    until_the_cut();
    disk_ = disk_->after_power_cut(random_);
    everything_reported_is_there();
    for (const auto& flight : recorded_flights(*disk_)) knows_ground_ |= flight.fixes > 0;
    drone_.clock().run_until(drone_.clock().now() + cut_.off);
    back_ = drone_.clock().now();
    goes_on_by_itself();
    everything_reported_is_there();
    for (const auto& flight : recorded_flights(*disk_)) check(flight);
    check_heights();
  }

 private:
  Devices devices() { return {drone_.clock(), *disk_, drone_.receiver(), &drone_.camera()}; }

  SessionEvents events(Session*& session) {
    SessionEvents events;
    events.stored = [this](int number, const std::string& folder) {
      EXPECT_TRUE(reported_.emplace(folder, number).second);
    };
    // The disk says nothing else than that it is off.
    events.said = [&session](const record::Message& said) {
      if (said.source == "disk" && said.severity == record::Severity::kFault) session->stop();
    };
    return events;
  }

  void until_the_cut() {
    Session* running = nullptr;
    if (cut_.operation && cut_.after == HostTime{}) {
      disk_->fail(*cut_.operation, sim::DiskFault::kPowerCut);
    }
    Session session(small_plan(), devices(), events(running));
    running = &session;
    if (!session.start()) return;
    session.run(cut_.operation ? std::max(cut_.after, drone_.clock().now()) : cut_.after);
    if (!cut_.operation) return;
    if (cut_.after != HostTime{}) {
      disk_->fail(disk_->operations() + *cut_.operation, sim::DiskFault::kPowerCut);
    }
    session.run(drone_.end());
  }

  void everything_reported_is_there() {
    for (const auto& [folder, number] : reported_) {
      const auto flight = recorded_flight(*disk_, folder);
      const auto stored = flight.stored.find(number);
      ASSERT_NE(stored, flight.stored.end()) << "photo " << number << " is not in the journal";
      EXPECT_TRUE(is_whole(*disk_, folder, stored->second));
    }
  }

  void goes_on_by_itself() {
    Session* running = nullptr;
    Session session(small_plan(), devices(), events(running));
    running = &session;
    const Status started = session.start();
    ASSERT_TRUE(started) << started.error().sentence;
    session.run(drone_.end());
    session.finish("switched off");
  }

  // Damage is cut off, so that all that remains reads well and ends.
  void check(const RecordedFlight& flight) {
    if (flight.summary.entries == 0) {  // cut while it was made
      const auto photos = disk_->list(flight.folder + "/photos");
      EXPECT_TRUE(!photos || photos->empty()) << flight.folder;
      return;
    }
    EXPECT_EQ(flight.summary.state, record::JournalState::kComplete) << flight.folder;
    std::set<int> entries;
    for (const auto& [number, stored] : flight.stored) {
      EXPECT_TRUE(is_whole(*disk_, flight.folder, stored));
      const auto taken = flight.taken.find(number);
      ASSERT_NE(taken, flight.taken.end()) << "nobody knows what photo " << number << " shows";
      check_place(taken->second);
      if (taken->second.target.entry < 0) continue;
      EXPECT_TRUE(entries.insert(taken->second.target.entry).second)
          << "twice at " << taken->second.target.height_m << " m";
    }
  }

  // Heights above the take-off point stay true, whatever the program has forgotten.
  void check_place(const capture::PhotoTaken& taken) {
    if (!taken.place || !knows_ground_) return;
    const double off_m = taken.place->height_m - drone_.place_m(taken.exposed).z();
    const double sigma_m = std::sqrt(taken.place->covariance_m2(2, 2));
    EXPECT_LT(std::abs(off_m), 0.2 + 5 * sigma_m) << "photo " << taken.number;
  }

  // A height that the drone passed, upwards or on its way down, while the program could know it.
  bool could_be_taken(double height_m) const {
    HostTime last;
    for (HostTime time; time < drone_.end(); time += milliseconds(50)) {
      if (drone_.place_m(time).z() >= height_m) last = time;
    }
    return last > back_ + kSettled;
  }

  void check_heights() {
    std::set<double> stored_m;
    int in_flights = 0;
    for (const auto& flight : recorded_flights(*disk_)) {
      in_flights += flight.stored.empty() ? 0 : 1;
      for (const auto& [number, stored] : flight.stored) {
        const auto taken = flight.taken.find(number);
        if (taken != flight.taken.end()) stored_m.insert(taken->second.target.height_m);
      }
    }
    EXPECT_LE(in_flights, 1) << "one flight became two";
    if (!knows_ground_) return;
    for (const double height_m : kHeights_m) {
      EXPECT_TRUE(stored_m.contains(height_m) || !could_be_taken(height_m)) << height_m << " m";
    }
  }

  Cut cut_;
  sim::Random random_;
  flights::Drone drone_;
  std::unique_ptr<sim::SimDisk> disk_;
  bool knows_ground_ = false;  // else it is switched on for the first time in the air, or before
  HostTime back_;
  std::set<std::pair<std::string, int>> reported_;
};

std::uint64_t operations_of_a_flight() {
  flights::Drone drone(small_flight());
  sim::SimDisk disk;
  Session session(small_plan(), {drone.clock(), disk, drone.receiver(), &drone.camera()}, {});
  EXPECT_TRUE(session.start());
  session.run(drone.end());
  session.finish("switched off");
  EXPECT_EQ(recorded_flight(disk, "0001").stored.size(), 4u);  // three heights and a side-step
  return disk.operations();
}

TEST(PowerCut, LosesNothingThatWasStoredWhateverTheDiskWasDoing) {
  const std::uint64_t operations = operations_of_a_flight();
  for (std::uint64_t k = 0; k < operations; ++k) {
    SCOPED_TRACE("cut at operation " + std::to_string(k) + " of " + std::to_string(operations));
    CutFlight({HostTime{}, k, k, seconds(2)}).fly();
  }
}

TEST(PowerCut, LosesNothingThatWasStoredAtAnyMoment) {
  const double end_s =
      std::chrono::duration<double>(flights::Drone(small_flight()).end() - HostTime{}).count();
  sim::Random random(1, 72);
  for (int moment = 0; moment < kMoments; ++moment) {
    Cut cut;
    cut.after = HostTime(nanoseconds(std::llround(1e9 * random.uniform(0, end_s))));
    if (random.uniform() < 0.5) cut.operation = random.next() % 12;
    cut.seed = random.next();
    cut.off = milliseconds(static_cast<int>(random.uniform(200, 8000)));
    SCOPED_TRACE("moment " + std::to_string(moment));
    CutFlight(cut).fly();
  }
}

}  // namespace
}  // namespace plumbline::flight
