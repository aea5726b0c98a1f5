// SPDX-License-Identifier: MIT
#include "firmware/flight/flight_folder.h"

#include <gtest/gtest.h>

#include <string>

#include "edge/record/journal.h"
#include "sim/sim_disk.h"

namespace plumbline::flight {
namespace {

std::string journal_of(std::initializer_list<capture::Decision> decisions) {
  std::string journal = record::journal_head();
  std::uint64_t sequence = 0;
  record::append_entry(record::Began{}, sequence++, journal);
  for (const auto& decision : decisions) record::append_entry(decision, sequence++, journal);
  return journal;
}

void put_flight(Storage& disk, const std::string& journal) {
  ASSERT_TRUE(disk.make_folder("0001"));
  ASSERT_TRUE(disk.make_folder("0001/photos"));
  ASSERT_TRUE(publish(disk, "0001/flight.journal", journal));
  ASSERT_TRUE(publish(disk, "0001/photos/0001.jpg", "a photo"));
}

TEST(FlightFolder, IsGoneOnWithFromTheGroundThatWasFoundInTheAir) {
  sim::SimDisk disk;
  put_flight(disk, journal_of({{HostTime{}, capture::PhaseChanged{capture::Phase::kFlying, {}}},
                               {HostTime{}, capture::GroundFound{52.5}}}));
  const auto flight = open_flight(disk);
  ASSERT_TRUE(flight) << flight.error().sentence;
  EXPECT_EQ(flight->folder, "0001");
  ASSERT_TRUE(flight->resumed);
  EXPECT_EQ(flight->resumed->ground_height_m, 52.5);
  EXPECT_EQ(flight->resumed->photos, 1);
}

// It would count its photos from 1 again.
TEST(FlightFolder, IsLeftAsItIsWhereItsGroundIsNotKnown) {
  sim::SimDisk disk;
  put_flight(disk, journal_of({{HostTime{}, capture::PhaseChanged{capture::Phase::kFlying, {}}}}));
  const auto flight = open_flight(disk);
  ASSERT_TRUE(flight) << flight.error().sentence;
  EXPECT_EQ(flight->folder, "0002");
  EXPECT_FALSE(flight->resumed);
  EXPECT_EQ(disk.read("0001/photos/0001.jpg").value(), "a photo");
}

}  // namespace
}  // namespace plumbline::flight
