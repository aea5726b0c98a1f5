// SPDX-License-Identifier: MIT
#include "tests/firmware/commands/acceptance/flight_folder.h"

#include <gmock/gmock.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>

namespace plumbline::acceptance {
namespace {

class LentFlight {
 public:
  LentFlight() {
    if (const char* lent = std::getenv("PLUMBLINE_ACCEPTANCE_FLIGHT")) path_ = lent;
    if (fs::is_directory(path_ / "truth")) return;
    path_ = fs::temp_directory_path() / ("plumbline-flight-" + std::to_string(::getpid()));
    mine_ = true;
    run_plumbline({"sim", path_.string(), "--seed", "7", "--profile", PLUMBLINE_SMALL_FLIGHT},
                  fs::temp_directory_path());
  }
  ~LentFlight() {
    if (mine_) fs::remove_all(path_);
  }
  const fs::path& path() const { return path_; }

 private:
  fs::path path_;
  bool mine_ = false;
};

std::string photo_name(int number) { return "000" + std::to_string(number) + ".jpg"; }

}  // namespace

const fs::path& shared_flight() {
  static const LentFlight flight;
  return flight.path();
}

void FolderTest::SetUp() {
  std::string name = (fs::temp_directory_path() / "plumbline-accept-XXXXXX").string();
  ASSERT_NE(::mkdtemp(name.data()), nullptr);
  folder = name;
}

void FolderTest::expect_refused(const std::vector<std::string>& arguments,
                                const std::string& sentence, int status) {
  const auto before = files_of(folder);
  const Outcome outcome = run_plumbline(arguments, folder);
  EXPECT_EQ(outcome.status, status);
  EXPECT_TRUE(outcome.err.starts_with("plumbline: ")) << outcome.err;
  EXPECT_THAT(outcome.err, testing::HasSubstr(sentence));
  EXPECT_EQ(std::count(outcome.err.begin(), outcome.err.end(), '\n'), 1) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  EXPECT_EQ(files_of(folder), before);
  EXPECT_FALSE(fs::exists(folder / "result"));
}

void FlightTest::SetUp() {
  FolderTest::SetUp();
  ASSERT_TRUE(fs::exists(shared_flight() / "photos" / photo_name(6)))
      << "the small flight could not be simulated";
  photos = folder / "photos";
  camera = folder / "camera.toml";
  picks = shared_flight() / "truth/picks.csv";
  check = shared_flight() / "truth/check.csv";
  fs::create_directory(photos);
  fs::copy_file(shared_flight() / "camera.toml", camera);
}

void FlightTest::copy_photos(int count) {
  for (int i = 1; i <= count; ++i) {
    fs::copy_file(shared_flight() / "photos" / photo_name(i), photos / photo_name(i));
  }
}

void FlightTest::copy_photos_without_tags() {
  for (int i = 1; i <= 6; ++i) {
    write_text(photos / photo_name(i),
               without_tags(text_of(shared_flight() / "photos" / photo_name(i))));
  }
}

namespace {

std::vector<std::string> with_camera(std::vector<std::string> options) {
  std::vector<std::string> arguments{"measure", "photos", "--camera", "camera.toml",
                                     "--out",   "result", "--ties",   "250"};
  arguments.insert(arguments.end(), options.begin(), options.end());
  return arguments;
}

}  // namespace

void FlightTest::expect_measure_refused(std::vector<std::string> options,
                                        const std::string& sentence) {
  expect_refused(with_camera(std::move(options)), sentence);
}

Outcome FlightTest::measure(std::vector<std::string> options) {
  return run_plumbline(with_camera(std::move(options)), folder);
}

std::string without_tags(const std::string& jpeg) {
  constexpr char kApp1 = static_cast<char>(0xE1), kScan = static_cast<char>(0xDA);
  std::string kept = jpeg.substr(0, 2);
  std::size_t at = 2;
  while (at + 4 <= jpeg.size() && jpeg[at + 1] != kScan) {
    const auto high = static_cast<unsigned char>(jpeg[at + 2]);
    const auto low = static_cast<unsigned char>(jpeg[at + 3]);
    const std::size_t length = 2 + std::size_t{high} * 256 + low;
    if (jpeg[at + 1] != kApp1) kept += jpeg.substr(at, length);
    at += length;
  }
  return kept + jpeg.substr(at);
}

}  // namespace plumbline::acceptance
