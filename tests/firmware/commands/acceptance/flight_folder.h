// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include "tests/firmware/commands/acceptance/program.h"

namespace plumbline::acceptance {

// The small flight of six photos (small_flight.toml), made once and only read. Where the
// environment does not lend one (CTest does), it is simulated on first use.
const fs::path& shared_flight();

// A folder of its own for each test, and commands run in it.
class FolderTest : public testing::Test {
 protected:
  void SetUp() override;
  void TearDown() override { fs::remove_all(folder); }

  // Holds for a run that says one sentence on stderr, ends with `status` and leaves every file as
  // it was.
  void expect_refused(const std::vector<std::string>& arguments, const std::string& sentence,
                      int status = 1);

  fs::path folder;
};

class FlightTest : public FolderTest {
 protected:
  void SetUp() override;

  // Photos 1 to `count` of the flight into `photos`, with the camera beside them.
  void copy_photos(int count = 6);
  void copy_photos_without_tags();
  void expect_measure_refused(std::vector<std::string> options, const std::string& sentence);

  // Measures the folder `photos` with the flight's camera into `result`.
  Outcome measure(std::vector<std::string> options);
  Json summary() const { return summary_of(folder / "result"); }

  fs::path photos, camera, picks, check;
};

// The photo without its APP1 segments: no EXIF and no XMP.
std::string without_tags(const std::string& jpeg);

}  // namespace plumbline::acceptance
