// SPDX-License-Identifier: MIT
#include "firmware/flight/session.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "edge/record/journal.h"
#include "edge/record/sha256.h"
#include "sim/sim_disk.h"
#include "tests/flights/drone.h"

namespace plumbline::flight {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

flights::DroneOptions short_flight() {
  flights::DroneOptions options;
  options.path.top_m = 47;
  options.path.aside_m = 11;
  options.receiver.interval = milliseconds(200);
  options.receiver.fixed_sigma = {0.005, 0.010};
  return options;
}

SessionOptions short_plan() {
  SessionOptions options;
  options.capture.plan.heights_m = {30, 35, 40, 45};
  options.threads = false;
  return options;
}

Devices devices_of(flights::Drone& drone, Storage& disk) {
  return {drone.clock(), disk, drone.receiver(), &drone.camera()};
}

std::vector<record::Entry> journal_of(Storage& disk, const std::string& folder,
                                      record::JournalSummary* summary = nullptr) {
  std::vector<record::Entry> entries;
  const auto bytes = disk.read(folder + "/flight.journal");
  EXPECT_TRUE(bytes) << (bytes ? "" : bytes.error().sentence);
  if (!bytes) return entries;
  auto reader = record::JournalReader::over(*bytes);
  EXPECT_TRUE(reader);
  while (auto entry = reader->next()) entries.push_back(std::move(*entry));
  if (summary != nullptr) *summary = reader->summary();
  return entries;
}

// Every photo that the journal names is there, whole; their numbers.
std::set<int> stored_photos(Storage& disk, const std::string& folder) {
  std::set<int> numbers;
  for (const auto& entry : journal_of(disk, folder)) {
    const auto* stored = std::get_if<record::Stored>(&entry);
    if (stored == nullptr) continue;
    const auto bytes = disk.read(folder + "/" + stored->name);
    EXPECT_TRUE(bytes) << stored->name;
    if (!bytes) continue;
    EXPECT_EQ(bytes->size(), stored->length);
    EXPECT_EQ(record::sha256(*bytes), stored->sha256);
    EXPECT_TRUE(numbers.insert(stored->number).second) << stored->number;
  }
  return numbers;
}

TEST(Session, PhotographsEveryHeightAndTheSideStepOfAClimb) {
  flights::Drone drone(short_flight());
  sim::SimDisk disk;
  std::vector<std::string> ended;
  SessionEvents events;
  events.ended = [&](const std::string& folder) { ended.push_back(folder); };
  Session session(short_plan(), devices_of(drone, disk), events);
  ASSERT_TRUE(session.start());
  session.run(drone.end());
  EXPECT_EQ(ended, std::vector<std::string>{"0001"});
  record::JournalSummary summary;
  std::map<double, double> heights_m;
  int aside = 0;
  for (const auto& entry : journal_of(disk, "0001", &summary)) {
    const auto* decision = std::get_if<capture::Decision>(&entry);
    if (decision == nullptr) continue;
    const auto* taken = std::get_if<capture::PhotoTaken>(&decision->what);
    if (taken == nullptr) continue;
    aside += taken->target.reason == capture::Reason::kAside ? 1 : 0;
    if (taken->target.reason == capture::Reason::kHeight) {
      heights_m[taken->target.height_m] = drone.place_m(taken->exposed).z();
    }
  }
  EXPECT_EQ(summary.state, record::JournalState::kComplete);
  EXPECT_EQ(heights_m.size(), 4u);
  for (const auto& [wanted, was] : heights_m) EXPECT_NEAR(was, wanted, 0.35);  // 2 m/s, 10 frames/s
  EXPECT_EQ(aside, 2);
  EXPECT_EQ(stored_photos(disk, "0001").size(), 6u);
}

TEST(Session, BeginsTheNextFlightAfterLanding) {
  flights::Drone drone(short_flight());
  sim::SimDisk disk;
  Session session(short_plan(), devices_of(drone, disk), {});
  ASSERT_TRUE(session.start());
  session.run(drone.end());
  session.finish("switched off");
  record::JournalSummary summary;
  EXPECT_FALSE(journal_of(disk, "0002", &summary).empty());
  EXPECT_EQ(summary.state, record::JournalState::kComplete);
}

// What is heard goes on from flight to flight: the next one has not seen a frame yet.
TEST(Session, TellsOfACameraThatIsPulledBetweenLandingAndTheNextFrame) {
  flights::Drone drone(short_flight());
  sim::SimDisk disk;
  bool streams = false;
  SessionEvents events;
  events.heard = [&](const capture::Input& input) {
    const auto* camera = std::get_if<capture::CameraSeen>(&input.what);
    if (camera != nullptr) streams = camera->streaming;
  };
  events.ended = [&](const std::string&) {
    EXPECT_TRUE(streams);
    drone.camera().unplug();
  };
  Session session(short_plan(), devices_of(drone, disk), events);
  ASSERT_TRUE(session.start());
  session.run(drone.end());
  EXPECT_FALSE(streams);
}

TEST(Session, GoesOnWithTheSameFlightAfterARestartInTheAir) {
  flights::Drone drone(short_flight());
  sim::SimDisk disk;
  {
    Session first(short_plan(), devices_of(drone, disk), {});
    ASSERT_TRUE(first.start());
    first.run(HostTime(seconds(40)));  // above 35 m
  }
  ASSERT_GT(drone.place_m(drone.clock().now()).z(), 35);
  Session second(short_plan(), devices_of(drone, disk), {});
  ASSERT_TRUE(second.start());
  second.run(drone.end());
  EXPECT_EQ(stored_photos(disk, "0001").size(), 6u);
  record::JournalSummary summary;
  journal_of(disk, "0001", &summary);
  EXPECT_EQ(summary.state, record::JournalState::kComplete);
}

// A flight whose receiver falls silent, and whose program is started anew 1 s later, in that boot.
std::vector<capture::PhotoTaken> photos_after_restart_without_receiver(const std::string& boot) {
  flights::DroneOptions options = short_flight();
  options.receiver.faults = {{39, 1000, sim::GnssFault::Kind::kSilent, {}}};
  flights::Drone drone(options);
  sim::SimDisk disk;
  SessionOptions plan = short_plan();
  plan.boot = "first";
  {
    Session first(plan, devices_of(drone, disk), {});
    EXPECT_TRUE(first.start());
    first.run(HostTime(seconds(40)));
  }
  plan.boot = boot;
  std::vector<capture::PhotoTaken> taken;
  SessionEvents events;
  events.decided = [&](const capture::Decision& decision) {
    const auto* photo = std::get_if<capture::PhotoTaken>(&decision.what);
    if (photo != nullptr) taken.push_back(*photo);
  };
  Session second(plan, devices_of(drone, disk), events);
  EXPECT_TRUE(second.start());
  second.run(HostTime(seconds(60)));
  return taken;
}

TEST(Session, PhotographsByTimeAfterARestartInTheAirWithoutReceiver) {
  const auto taken = photos_after_restart_without_receiver("first");
  EXPECT_GE(taken.size(), 6u);  // every 2 s after 5 s
  for (const auto& photo : taken) {
    EXPECT_EQ(photo.target.reason, capture::Reason::kBlind);
    EXPECT_TRUE(photo.marks.no_position && photo.marks.resumed);
  }
}

// After a night nobody knows that it is in the air.
TEST(Session, WaitsForAPositionWhereTheComputerWasSwitchedOffMeanwhile) {
  EXPECT_TRUE(photos_after_restart_without_receiver("second").empty());
}

}  // namespace
}  // namespace plumbline::flight
