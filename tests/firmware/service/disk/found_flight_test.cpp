// SPDX-License-Identifier: MIT
#include "firmware/service/disk/found_flight.h"

#include <gtest/gtest.h>

#include <chrono>
#include <filesystem>
#include <string>

#include "edge/record/journal.h"
#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::service {
namespace {

namespace fs = std::filesystem;

// Photos that were written an hour ago.
void put_photos(const ingest::TemporaryFolder& flights, const std::string& flight, int photos) {
  for (int k = 1; k <= photos; ++k) {
    const auto file =
        flights.write(flight + "/photos/" + std::to_string(k) + ".jpg", std::string("x"));
    fs::last_write_time(file, fs::file_time_type::clock::now() - std::chrono::hours(1));
  }
}

TEST(NewestFlight, IsTheLastThatHasPhotosEnough) {
  const ingest::TemporaryFolder flights;
  EXPECT_FALSE(newest_flight(flights.path(), 3));
  put_photos(flights, "9999", 5);
  put_photos(flights, "10000", 4);
  put_photos(flights, "10001", 2);
  put_photos(flights, "mine", 9);
  flights.write("10000/photos/0005.jpg.part", std::string("x"));
  const auto found = newest_flight(flights.path(), 3);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->flight, "10000");
  EXPECT_EQ(found->photos, 4);
  EXPECT_FALSE(found->is_measured);
}

TEST(NewestFlight, IsMeasuredWhereItsResultIsNotOlderThanItsPhotos) {
  const ingest::TemporaryFolder flights;
  put_photos(flights, "0001", 3);
  const auto summary = flights.write("0001/result/summary.json", std::string("{}"));
  EXPECT_TRUE(newest_flight(flights.path(), 3)->is_measured);
  fs::last_write_time(summary, fs::file_time_type::clock::now() - std::chrono::hours(2));
  EXPECT_FALSE(newest_flight(flights.path(), 3)->is_measured);
}

TEST(NewestFlight, IsNotMeasuredAgainWhereItsResultMadeRoom) {
  const ingest::TemporaryFolder flights;
  put_photos(flights, "0001", 3);
  fs::create_directory(flights / "0001/result");
  EXPECT_TRUE(newest_flight(flights.path(), 3)->is_measured);
}

TEST(HasEnded, IsWhatTheRecordingSaysLast) {
  const ingest::TemporaryFolder folder;
  EXPECT_FALSE(has_ended(folder.path()));
  std::string journal = record::journal_head();
  record::append_entry(record::Began{"plumblined", "", "boot", {}, {}}, 0, journal);
  record::append_entry(record::Ended{{}, "stopped"}, 1, journal);
  folder.write("flight.journal", journal);
  EXPECT_TRUE(has_ended(folder.path()));
  record::append_entry(record::Began{"plumblined", "", "boot", {}, {}}, 2, journal);
  folder.write("flight.journal", journal);
  EXPECT_FALSE(has_ended(folder.path()));
}

}  // namespace
}  // namespace plumbline::service
