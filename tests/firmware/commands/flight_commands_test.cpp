// SPDX-License-Identifier: MIT
// plumbline check, replay and status, on a flight that the daemon's session recorded on a real
// disk.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "drivers/posix/posix_storage.h"
#include "edge/record/journal.h"
#include "firmware/commands/check_command.h"
#include "firmware/commands/replay_command.h"
#include "firmware/commands/status_command.h"
#include "firmware/flight/session.h"
#include "tests/firmware/commands/run_command.h"
#include "tests/firmware/ingest/temporary_folder.h"
#include "tests/flights/drone.h"

namespace plumbline::commands {
namespace {

namespace fs = std::filesystem;
using std::chrono::seconds;
using ::testing::HasSubstr;
using ::testing::StartsWith;

// The configuration of the flight, and what it amounts to.
constexpr const char* kConfiguration = "[capture]\nheights_m = [10, 13, 16]\n";

// Records one flight, up to `until`.
void record_flight(const fs::path& folder, HostTime until) {
  flights::DroneOptions options;
  options.path.wait_s = 6;
  options.path.top_m = 18;
  options.path.aside_m = 6;
  options.receiver.fixed_sigma = {0.005, 0.010};
  options.camera.frames_per_s = 5;
  flights::Drone drone(options);
  const auto disk = posix::open_storage(folder.string());
  ASSERT_TRUE(disk);
  flight::SessionOptions session_options;
  session_options.capture.plan.heights_m = {10, 13, 16};
  session_options.configuration = kConfiguration;
  session_options.threads = false;
  flight::Session session(session_options,
                          {drone.clock(), **disk, drone.receiver(), &drone.camera()}, {});
  ASSERT_TRUE(session.start());
  session.run(std::min(until, drone.end()));
}

class FlightCommand : public testing::Test {
 protected:
  void SetUp() override { record_flight(folder_.path(), HostTime::max()); }

  fs::path flight() const { return folder_.path() / "0001"; }

  int run(std::vector<std::string> arguments) {
    const auto add = [](CLI::App& app, int& status) {
      add_check(app, status);
      add_replay(app, status);
      add_status(app, status);
    };
    const CommandRun command = run_command(add, std::move(arguments));
    printed = command.printed;
    told = command.told;
    return command.status;
  }

  std::string journal() const {
    std::ifstream file(flight() / "flight.journal", std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
  }
  void write_journal(const std::string& bytes) const {
    std::ofstream(flight() / "flight.journal", std::ios::binary | std::ios::trunc) << bytes;
  }

  ingest::TemporaryFolder folder_;
  std::string printed, told;
};

TEST_F(FlightCommand, CheckSaysOfAWholeFlightWhatIsInIt) {
  EXPECT_EQ(run({"check", flight().string()}), 0);
  EXPECT_THAT(printed, StartsWith("The recording is complete.\n"));
  EXPECT_THAT(printed, HasSubstr("4 photos taken, 4 stored, 0 missed, 0 faults\n"));
  EXPECT_EQ(told, "");
}

TEST_F(FlightCommand, CheckNamesAPhotoThatIsNotWhatWasStored) {
  std::ofstream(flight() / "photos/0002.jpg", std::ios::app) << 'x';
  fs::remove(flight() / "photos/0003.jpg");
  EXPECT_EQ(run({"check", flight().string(), "--json"}), 1);
  const auto json = nlohmann::json::parse(printed);
  EXPECT_EQ(json["state"], "damaged");
  ASSERT_EQ(json["broken_photos"].size(), 2u);
  EXPECT_THAT(json["broken_photos"][0].get<std::string>(), StartsWith("photos/0002.jpg has "));
  EXPECT_EQ(json["broken_photos"][1], "photos/0003.jpg is missing.");
}

TEST_F(FlightCommand, CheckTellsACutFromDamage) {
  const std::string whole = journal();
  write_journal(whole.substr(0, whole.size() * 2 / 3 + 1));
  EXPECT_EQ(run({"check", flight().string()}), 1);
  EXPECT_THAT(printed, StartsWith("The recording is truncated"));
  std::string bent = whole;
  bent[bent.size() / 2] = static_cast<char>(bent[bent.size() / 2] ^ 1);
  write_journal(bent);
  EXPECT_EQ(run({"check", flight().string()}), 1);
  EXPECT_THAT(printed, StartsWith("The recording is damaged"));
}

TEST_F(FlightCommand, CheckDumpsALineForEachEntry) {
  EXPECT_EQ(run({"check", flight().string(), "--dump"}), 0);
  EXPECT_THAT(printed, HasSubstr(" taken      photo=4 for=aside"));
  EXPECT_EQ(told, "The recording is complete.\n");
  const auto lines = std::count(printed.begin(), printed.end(), '\n');
  EXPECT_EQ(run({"check", flight().string(), "--json"}), 0);
  EXPECT_EQ(nlohmann::json::parse(printed)["entries"], lines);
}

TEST_F(FlightCommand, SaysWhereThereIsNoFlight) {
  for (const char* command : {"check", "replay"}) {
    EXPECT_EQ(run({command, folder_.path().string()}), 1);
    EXPECT_THAT(told, HasSubstr("holds no flight.journal: give the folder of one flight."));
  }
  EXPECT_EQ(run({"status", "--socket", (folder_.path() / "none").string()}), 1);
  EXPECT_THAT(told, HasSubstr("No daemon answers at "));
}

TEST_F(FlightCommand, ReplayDecidesAsFlown) {
  EXPECT_EQ(run({"replay", flight().string(), "--json"}), 0) << printed;
  const auto json = nlohmann::json::parse(printed);
  EXPECT_EQ(json["decisions"], json["as_flown"]);
  EXPECT_GE(json["decisions"], 7);  // phases, and four photos
  EXPECT_TRUE(json["differences"].empty());
}

// What is whole is played, and all of it as flown; that it is not all there is said, as check does.
TEST_F(FlightCommand, ReplayGoesUpToTheLastWholeEntryOfACutRecording) {
  const std::string whole = journal();
  write_journal(whole.substr(0, whole.size() * 2 / 3 + 1));
  EXPECT_EQ(run({"replay", flight().string()}), 1);
  EXPECT_THAT(printed, StartsWith("The recording is truncated: "));
  EXPECT_EQ(run({"replay", flight().string(), "--json"}), 1);
  const auto json = nlohmann::json::parse(printed);
  EXPECT_EQ(json["state"], "truncated");
  EXPECT_GT(json["as_flown"], 0);
  EXPECT_TRUE(json["differences"].empty()) << printed;
}

TEST_F(FlightCommand, ReplaySaysThatARecordingIsDamaged) {
  std::string bent = journal();
  bent[bent.size() / 2] = static_cast<char>(bent[bent.size() / 2] ^ 1);
  write_journal(bent);
  EXPECT_EQ(run({"replay", flight().string()}), 1);
  EXPECT_THAT(printed, StartsWith("The recording is damaged: "));
  EXPECT_THAT(printed, HasSubstr(" inputs, "));
}

TEST_F(FlightCommand, SaysThatAnEmptyJournalHoldsNothing) {
  write_journal("");
  for (const char* command : {"check", "replay"}) {
    EXPECT_EQ(run({command, flight().string()}), 1);
    EXPECT_THAT(printed, StartsWith("The recording is truncated: its journal holds nothing"));
  }
}

TEST_F(FlightCommand, ReplayRefusesASpeedThatIsNone) {
  for (const char* speed : {"-1", "x", "nan", "inf", "1e-300"}) {
    EXPECT_EQ(run({"replay", flight().string(), "--speed", speed}), 2) << speed;
  }
  EXPECT_EQ(run({"replay", flight().string(), "--speed", "1000"}), 0);
}

TEST_F(FlightCommand, CheckSaysWhetherTheDroneLanded) {
  EXPECT_EQ(run({"check", flight().string()}), 0);
  EXPECT_THAT(printed, HasSubstr("1 start of the program, flown and landed\n"));
  const std::string whole = journal();
  write_journal(whole.substr(0, whole.size() * 2 / 3 + 1));
  EXPECT_EQ(run({"check", flight().string()}), 1);
  EXPECT_THAT(printed, HasSubstr(", flown, and no landing recorded\n"));
  write_journal(whole.substr(0, whole.size() / 50));
  EXPECT_EQ(run({"check", flight().string(), "--json"}), 1);
  EXPECT_EQ(nlohmann::json::parse(printed)["landed"], false);
}

TEST_F(FlightCommand, CheckSaysWhichHeightsHaveNoPhoto) {
  const auto height = [](int entry, double height_m) {
    return capture::Target{capture::Reason::kHeight, entry, height_m};
  };
  capture::PhotoTaken late;
  late.target = height(2, 16);
  const std::vector<capture::Decided> decided = {
      capture::PhaseChanged{capture::Phase::kFlying, 50.0}, capture::HeightPassed{height(1, 12.5)},
      capture::HeightPassed{height(2, 16)}, late};
  std::string journal = record::journal_head();
  std::uint64_t sequence = 0;
  record::append_entry(record::Began{}, sequence++, journal);
  for (const auto& what : decided) {
    record::append_entry(capture::Decision{HostTime{}, what}, sequence++, journal);
  }
  write_journal(journal);
  (void)run({"check", flight().string()});
  EXPECT_THAT(printed, HasSubstr("No photo at 12.5 m: the drone went by.\n"));
  EXPECT_THAT(printed, ::testing::Not(HasSubstr("16 m")));
  (void)run({"check", flight().string(), "--json"});
  EXPECT_EQ(nlohmann::json::parse(printed)["heights_without_photo_m"],
            nlohmann::json::array({12.5}));
}

// After a power cut the host's clock begins anew.
TEST_F(FlightCommand, CheckAddsUpHowLongEachBootRecorded) {
  std::string journal = record::journal_head();
  std::uint64_t sequence = 0;
  const auto began = [&](const std::string& boot) {
    record::Began entry;
    entry.boot = boot;
    record::append_entry(entry, sequence++, journal);
  };
  const auto lived = [&](int from_s, int to_s) {
    for (const int s : {from_s, to_s}) {
      const capture::Input tick{HostTime(seconds(s)), capture::Tick{}};
      record::append_entry(tick, sequence++, journal);
    }
  };
  began("first");
  lived(100, 130);
  began("first");  // the program alone
  lived(135, 140);
  began("second");
  lived(10, 15);
  write_journal(journal);
  (void)run({"check", flight().string(), "--json"});
  EXPECT_DOUBLE_EQ(nlohmann::json::parse(printed)["duration_s"], 45);
}

TEST_F(FlightCommand, CheckSaysThatNoPhotoWasTaken) {
  const std::string whole = journal();
  write_journal(whole.substr(0, whole.size() / 50));
  fs::remove_all(flight() / "photos");
  EXPECT_EQ(run({"check", flight().string()}), 1);
  EXPECT_THAT(printed, HasSubstr(", no take-off recorded\nNo photo was taken, 0 faults\n"));
}

TEST_F(FlightCommand, ReplayWritesWhatItDecides) {
  const fs::path out = folder_.path() / "out";
  EXPECT_EQ(run({"replay", flight().string(), "--out", out.string()}), 0);
  std::ifstream file(out / "decisions.txt");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(text, HasSubstr("photo=1 for=height step_m=10.00"));
}

}  // namespace
}  // namespace plumbline::commands
