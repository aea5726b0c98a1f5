// SPDX-License-Identifier: MIT
#include "tests/firmware/flight/interrupted_flight.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace plumbline::flight {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr double kInterruptedHeights_m[] = {10, 13, 16};
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

}  // namespace

InterruptedFlight::InterruptedFlight() : drone_(small_flight()) {}

SessionOptions InterruptedFlight::plan() {
  SessionOptions options;
  options.capture.plan.heights_m.assign(std::begin(kInterruptedHeights_m),
                                        std::end(kInterruptedHeights_m));
  options.threads = false;
  return options;
}

void InterruptedFlight::reported(const std::string& folder, int number) {
  EXPECT_TRUE(reported_.emplace(folder, number).second);
}

void InterruptedFlight::go_on(Storage& disk, nanoseconds off) {
  everything_reported_is_there(disk);
  for (const auto& flight : recorded_flights(disk)) knows_ground_ |= flight.fixes > 0;
  drone_.clock().run_until(drone_.clock().now() + off);
  back_ = drone_.clock().now();
  goes_on_by_itself(disk);
  everything_reported_is_there(disk);
  for (const auto& flight : recorded_flights(disk)) check(disk, flight);
  check_heights(disk);
}

void InterruptedFlight::everything_reported_is_there(Storage& disk) const {
  for (const auto& [folder, number] : reported_) {
    const auto flight = recorded_flight(disk, folder);
    const auto stored = flight.stored.find(number);
    ASSERT_NE(stored, flight.stored.end()) << "photo " << number << " is not in the journal";
    EXPECT_TRUE(is_whole(disk, folder, stored->second));
  }
}

void InterruptedFlight::goes_on_by_itself(Storage& disk) {
  SessionEvents events;
  events.stored = [this](int number, const std::string& folder) { reported(folder, number); };
  Session session(plan(), devices(disk), events);
  const Status started = session.start();
  ASSERT_TRUE(started) << started.error().sentence;
  session.run(drone_.end());
  session.finish("switched off");
}

// Damage is cut off, so that all that remains reads well and ends.
void InterruptedFlight::check(Storage& disk, const RecordedFlight& flight) {
  if (flight.summary.entries == 0) {  // cut while it was made
    const auto photos = disk.list(flight.folder + "/photos");
    EXPECT_TRUE(!photos || photos->empty()) << flight.folder;
    return;
  }
  EXPECT_EQ(flight.summary.state, record::JournalState::kComplete) << flight.folder;
  std::set<int> entries;
  for (const auto& [number, stored] : flight.stored) {
    EXPECT_TRUE(is_whole(disk, flight.folder, stored));
    const auto taken = flight.taken.find(number);
    ASSERT_NE(taken, flight.taken.end()) << "nobody knows what photo " << number << " shows";
    check_place(taken->second);
    if (taken->second.target.entry < 0) continue;
    EXPECT_TRUE(entries.insert(taken->second.target.entry).second)
        << "twice at " << taken->second.target.height_m << " m";
  }
}

// Heights above the take-off point stay true, whatever the program has forgotten.
void InterruptedFlight::check_place(const capture::PhotoTaken& taken) {
  if (!taken.place || !knows_ground_) return;
  const double off_m = taken.place->height_m - drone_.place_m(taken.exposed).z();
  const double sigma_m = std::sqrt(taken.place->covariance_m2(2, 2));
  EXPECT_LT(std::abs(off_m), 0.2 + 5 * sigma_m) << "photo " << taken.number;
}

// A height that the drone passed, upwards or on its way down, while the program could know it.
bool InterruptedFlight::could_be_taken(double height_m) {
  HostTime last;
  for (HostTime time; time < drone_.end(); time += milliseconds(50)) {
    if (drone_.place_m(time).z() >= height_m) last = time;
  }
  return last > back_ + kSettled;
}

void InterruptedFlight::check_heights(Storage& disk) {
  std::set<double> stored_m;
  int in_flights = 0;
  for (const auto& flight : recorded_flights(disk)) {
    in_flights += flight.stored.empty() ? 0 : 1;
    for (const auto& [number, stored] : flight.stored) {
      const auto taken = flight.taken.find(number);
      if (taken != flight.taken.end()) stored_m.insert(taken->second.target.height_m);
    }
  }
  EXPECT_LE(in_flights, 1) << "one flight became two";
  if (!knows_ground_) return;
  for (const double height_m : kInterruptedHeights_m) {
    EXPECT_TRUE(stored_m.contains(height_m) || !could_be_taken(height_m)) << height_m << " m";
  }
}

}  // namespace plumbline::flight
