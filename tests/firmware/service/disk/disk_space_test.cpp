// SPDX-License-Identifier: MIT
#include "firmware/service/disk/disk_space.h"

#include <gtest/gtest.h>

#include <string>

#include "sim/sim_disk.h"

namespace plumbline::service {
namespace {

constexpr const char* kFlights[] = {"0998", "9998", "9999", "10000"};

void put_flights(Storage& disk) {
  for (const std::string flight : kFlights) {
    ASSERT_TRUE(disk.make_folder(flight + "/photos"));
    ASSERT_TRUE(disk.make_folder(flight + "/result"));
    for (const char* file :
         {"/flight.journal", "/photos/0001.jpg", "/result/points.csv", "/result/report.html"}) {
      ASSERT_TRUE(publish(disk, flight + file, std::string(1000, 'x')));
    }
  }
}

std::size_t results_of(Storage& disk, const std::string& flight) {
  return disk.list(flight + "/result").value().size();
}

TEST(CleanResults, RemovesTheOldestUntilThereIsRoomAndNothingElse) {
  sim::SimDisk disk;
  put_flights(disk);
  EXPECT_EQ(clean_results(disk, [&] { return results_of(disk, "0998") == 0; }), 1);
  EXPECT_EQ(results_of(disk, "0998"), 0u);
  EXPECT_EQ(results_of(disk, "9998"), 2u);
  for (const std::string flight : kFlights) {
    EXPECT_TRUE(disk.read(flight + "/flight.journal"));
    EXPECT_TRUE(disk.read(flight + "/photos/0001.jpg"));
  }
}

TEST(CleanResults, LeavesTheNewestTwoFlightsTheirResults) {
  sim::SimDisk disk;
  put_flights(disk);
  EXPECT_EQ(clean_results(disk, [] { return false; }), 2);
  EXPECT_EQ(results_of(disk, "9999"), 2u);
  EXPECT_EQ(results_of(disk, "10000"), 2u);
  EXPECT_EQ(clean_results(disk, [] { return false; }), 0) << "what is clean is not counted";
}

TEST(CleanResults, TouchesNoFolderThatIsNoFlight) {
  sim::SimDisk disk;
  put_flights(disk);
  ASSERT_TRUE(disk.make_folder("mine/result"));
  ASSERT_TRUE(publish(disk, "mine/result/thesis", "x"));
  clean_results(disk, [] { return false; });
  EXPECT_TRUE(disk.read("mine/result/thesis"));
}

TEST(PhotosThatFit, AreCountedBesideWhatIsToStayFree) {
  sim::SimDisk disk(30'000'000'000);
  const PhotoSize three_megabytes{4000, 2000};
  const auto free = disk.free_bytes();
  ASSERT_TRUE(free);
  const auto photos = photos_that_fit(disk, three_megabytes, 0);
  ASSERT_TRUE(photos);
  EXPECT_EQ(*photos, static_cast<std::int64_t>(*free / 3'000'000));
  EXPECT_EQ(photos_that_fit(disk, three_megabytes, 10'000'000), 0);
}

TEST(PhotoSize, IsAsConfiguredElseAsTheCameraShows) {
  CameraOptions options;
  EXPECT_EQ(photo_size(options).height_px, 3040);
  EXPECT_EQ(photo_size(options, 900).height_px, 900);
  EXPECT_EQ(photo_size(options, 900).width_px, 1600);
  options.width_px = 1200;
  EXPECT_EQ(photo_size(options, 900).width_px, 1200);
}

TEST(PhotosPlanned, AreThoseOfTheHeightsTheSideStepAndHalfAnHourOfGrid) {
  capture::CapturePlan plan;
  plan.heights_m = {30, 40};
  EXPECT_EQ(photos_planned(plan), 3);
  plan.aside_m.reset();
  plan.every = std::chrono::seconds(10);
  EXPECT_EQ(photos_planned(plan), 182);
  plan.every_m = 50;
  EXPECT_EQ(photos_planned(plan), 362);
}

}  // namespace
}  // namespace plumbline::service
