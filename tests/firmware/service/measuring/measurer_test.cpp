// SPDX-License-Identifier: MIT
// The measuring process is a shell script that stands for plumbline.
#include "firmware/service/measuring/measurer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

#include "edge/record/journal.h"
#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::service {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;
using ::testing::StartsWith;

std::string content_of(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path).rdbuf();
  return text.str();
}

class MeasuringProcess : public testing::Test {
 protected:
  void SetUp() override { std::filesystem::create_directory(folder_.path() / "0001"); }

  // The measurer of a program that is this script.
  Measurer& measurer_of(const std::string& script) {
    const auto program = folder_.path() / "program";
    std::ofstream(program) << "#!/bin/sh\n" << script << '\n';
    std::filesystem::permissions(program, std::filesystem::perms::owner_all);
    options_.flights = folder_.path().string();
    options_.program = program.string();
    Measurer::Events events;
    events.measured = [this](const Measurer::Measured& measured) {
      keep((measured.was_left ? "left: " : "measured: ") + measured.sentence +
           (measured.figures ? " " + in_words(*measured.figures) : ""));
    };
    events.failed = [this](const std::string&, const std::string& sentence) {
      keep("failed: " + sentence);
    };
    events.begun = [this](const std::string& flight, const std::string& sentence) {
      keep("begun: " + flight + ": " + sentence);
    };
    measurer_.emplace(options_, events);
    return *measurer_;
  }

  // The sentences said so far, once there are so many; what there is after two minutes: a process
  // of idle priority gets little of a machine on which other tests run.
  std::vector<std::string> said(std::size_t count) {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, 120s, [&] { return sentences_.size() >= count; });
    return sentences_;
  }

  std::string log() const { return content_of(folder_.path() / "0001/measure.log"); }
  std::string flight() const { return (folder_.path() / "0001").string(); }

  ingest::TemporaryFolder folder_;
  MeasurerOptions options_;

 private:
  void keep(const std::string& sentence) {
    const std::lock_guard lock(mutex_);
    sentences_.push_back(sentence);
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<std::string> sentences_;
  std::optional<Measurer> measurer_;  // the last: it ends before what it calls
};

TEST_F(MeasuringProcess, StartsAtTheThirdPhotoOnWhatIsOnTheDisk) {
  Measurer& measurer = measurer_of("echo \"$@\"; echo 'Measured from 3 photos: there.'");
  measurer.stored("0001");
  measurer.stored("0001");
  std::this_thread::sleep_for(300ms);
  EXPECT_TRUE(said(0).empty());
  measurer.stored("0001");
  const auto sentences = said(1);
  ASSERT_EQ(sentences.size(), 1u);
  EXPECT_EQ(sentences[0], "measured: Measured from 3 photos: there.");
  EXPECT_THAT(log(),
              StartsWith("measure " + flight() + " --out " + flight() + "/result --follow\n"));
}

TEST_F(MeasuringProcess, TellsTheFiguresOfAResult) {
  Measurer& measurer = measurer_of(
      "mkdir \"$4\"; echo '{\"photos_used\": 3, \"unobservable\": [\"azimuth\"], \"point_sigmas\": "
      "{\"median_e_m\": 0.05, \"median_n_m\": 0.04, \"median_u_m\": 0.03}}' > \"$4/summary.json\"; "
      "echo 'Measured from 3 photos: there.'");
  for (int photo = 1; photo <= 3; ++photo) measurer.stored("0001");
  EXPECT_EQ(said(1).back(),
            "measured: Measured from 3 photos: there. Median sigma 5.0/4.0/3.0 cm east/north/up, "
            "azimuth unknown.");
}

TEST_F(MeasuringProcess, TellsOfEachResultWhileItFollowsTheFlight) {
  Measurer& measurer = measurer_of(
      "echo Measured from 3 photos: a.; echo beside; while [ ! -e \"$2/more\" ]; do sleep 0.05; "
      "done; printf 'Measured from '; sleep 0.2; echo 5 photos: b.");
  for (int photo = 1; photo <= 3; ++photo) measurer.stored("0001");
  EXPECT_EQ(said(1).size(), 1u);
  for (int photo = 4; photo <= 5; ++photo) measurer.stored("0001");
  std::ofstream(folder_.path() / "0001/more") << '\n';
  EXPECT_EQ(said(2).back(), "measured: Measured from 5 photos: b.");
  std::this_thread::sleep_for(400ms);
  EXPECT_EQ(said(0).size(), 2u) << "one process for all";
}

TEST_F(MeasuringProcess, IsHumble) {
  options_.first_at = 1;
  options_.memory_mb = 777;
  Measurer& measurer =
      measurer_of("nice; ulimit -v; cat /proc/self/oom_score_adj; echo Measured from 1 photo.");
  measurer.stored("0001");
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_THAT(log(), StartsWith("19\n" + std::to_string(777 * 1024) + "\n1000\n"));
}

TEST_F(MeasuringProcess, IsNotedWhereItDiesAndStartedAgainAfterLanding) {
  options_.first_at = 1;
  Measurer& measurer = measurer_of("kill -SEGV $$");
  measurer.stored("0001");
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_THAT(said(1)[0], HasSubstr("failed: The measuring process was ended by signal 11"));
  EXPECT_THAT(said(1)[0], HasSubstr("the photos are kept"));
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(said(0).size(), 1u) << "not again without a photo more";
  measurer.ended("0001");
  EXPECT_EQ(said(2).size(), 2u);
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(said(0).size(), 2u) << "once";
}

TEST_F(MeasuringProcess, EndsWhereItTakesTooLong) {
  options_.first_at = 1;
  options_.longest = 1s;
  Measurer& measurer = measurer_of("exec sleep 60");
  measurer.stored("0001");
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_THAT(said(1)[0], HasSubstr("ended by signal 9"));
}

TEST_F(MeasuringProcess, MayWaitForTheNextPhotoAsLongAsItTakes) {
  options_.first_at = 1;
  options_.longest = 1s;
  Measurer& measurer = measurer_of("echo Measured from 1 photos: a.; exec sleep 60");
  measurer.stored("0001");
  ASSERT_EQ(said(1).size(), 1u);
  std::this_thread::sleep_for(2500ms);
  EXPECT_EQ(said(0).size(), 1u) << "nothing is due";
  measurer.stored("0001");
  ASSERT_EQ(said(2).size(), 2u);
  EXPECT_THAT(said(2)[1], HasSubstr("ended by signal 9"));
}

// tail keeps the last line, here 30 MB of it.
TEST_F(MeasuringProcess, EndsWhereItTakesTooMuchMemory) {
  options_.first_at = 1;
  options_.memory_mb = 16;
  Measurer& measurer = measurer_of("head -c 30000000 /dev/zero | tail -n 1 > /dev/null");
  measurer.stored("0001");
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_THAT(said(1)[0], HasSubstr("failed: The measuring process failed"));
  EXPECT_THAT(log(), HasSubstr("memory"));
}

TEST_F(MeasuringProcess, IsNotedWhereItFindsItsInputBadOrIsNotThere) {
  options_.first_at = 1;
  Measurer& measurer = measurer_of("echo 'No photo.' >&2; exit 1");
  measurer.stored("0001");
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_THAT(said(1)[0], HasSubstr("0001/measure.log says why"));
  EXPECT_EQ(log(), "No photo.\n");
  std::filesystem::remove(folder_.path() / "program");
  measurer.stored("0001");
  EXPECT_EQ(said(2).size(), 2u);
}

// Of a flight of so many photos that ended, or did not.
void write_flight(const std::filesystem::path& folder, int photos, bool ended) {
  std::filesystem::create_directories(folder / "photos");
  for (int k = 1; k <= photos; ++k) {
    std::ofstream(folder / ("photos/000" + std::to_string(k) + ".jpg")) << "x";
  }
  std::string journal = record::journal_head();
  record::append_entry(record::Began{"plumblined", "", "boot", {}, {}}, 0, journal);
  if (ended) record::append_entry(record::Ended{{}, "landed"}, 1, journal);
  std::ofstream(folder / "flight.journal", std::ios::binary) << journal;
}

TEST_F(MeasuringProcess, MeasuresAFlightThatWasLeftWithoutItsResultOnce) {
  write_flight(flight(), 3, true);
  Measurer& measurer = measurer_of("echo 'Measured from 3 photos: there.'; exit 1");
  const auto found = newest_flight(folder_.path(), 3);
  ASSERT_TRUE(found);
  measurer.found(*found, false);
  const auto sentences = said(3);
  ASSERT_EQ(sentences.size(), 3u);
  EXPECT_EQ(sentences[0], "begun: 0001: It has no result yet, and is measured now.");
  EXPECT_EQ(sentences[1], "left: Measured from 3 photos: there.");
  EXPECT_THAT(sentences[2], HasSubstr("failed: The measuring process failed"));
  std::this_thread::sleep_for(400ms);
  EXPECT_EQ(said(0).size(), 3u) << "once";
}

TEST_F(MeasuringProcess, OfAFlightThatWasLeftIsBoundedInTime) {
  write_flight(flight(), 3, true);
  options_.longest = 1s;
  measurer_of("exec sleep 60").found({"0001", 3, false}, false);
  ASSERT_EQ(said(2).size(), 2u);
  EXPECT_THAT(said(2)[1], HasSubstr("ended by signal 9"));
}

TEST_F(MeasuringProcess, OfAFlightThatWasLeftGivesWayToOneThatIsFlown) {
  write_flight(flight(), 3, true);
  std::filesystem::create_directory(folder_ / "0002");
  // The one that was left takes long the first time.
  Measurer& measurer = measurer_of(
      "case $2 in *0001) if [ ! -e \"$2/begun\" ]; then touch \"$2/begun\"; exec sleep 60; fi;; "
      "esac; echo Measured from 3 photos: $2.");
  measurer.found({"0001", 3, false}, false);
  ASSERT_THAT(said(1).back(), HasSubstr("begun: 0001"));
  for (int k = 0; k < 2400 && !std::filesystem::exists(flight() + "/begun"); ++k) {
    std::this_thread::sleep_for(50ms);
  }
  for (int photo = 1; photo <= 3; ++photo) measurer.stored("0002");
  EXPECT_EQ(said(2).back(),
            "measured: Measured from 3 photos: " + folder_.path().string() + "/0002.");
  std::this_thread::sleep_for(300ms);
  EXPECT_EQ(said(0).size(), 2u) << "while one is flown";
  measurer.ended("0002");
  const auto sentences = said(4);
  ASSERT_EQ(sentences.size(), 4u);
  EXPECT_THAT(sentences[2], HasSubstr("begun: 0001"));
  EXPECT_EQ(sentences[3], "left: Measured from 3 photos: " + flight() + ".");
}

TEST_F(MeasuringProcess, FollowsAFlightThatIsGoneOnWithFromItsFirstNewPhoto) {
  Measurer& measurer = measurer_of("echo Measured from 14 photos: a.");
  measurer.found({"0001", 14, true}, true);
  std::this_thread::sleep_for(400ms);
  EXPECT_TRUE(said(0).empty()) << "its result is as new as its photos";
  measurer.stored("0001");
  EXPECT_EQ(said(1).size(), 1u);
}

TEST_F(MeasuringProcess, LeavesARecordingWithoutEndAndSaysSo) {
  write_flight(flight(), 3, false);
  measurer_of("echo never").found({"0001", 3, false}, false);
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_THAT(said(1)[0], HasSubstr("its recording has no end; plumbline measure " + flight()));
  EXPECT_FALSE(std::filesystem::exists(flight() + "/measure.log"));
}

// As plumbline measure puts it in place: whole, by a new name.
void write_result(const std::string& flight, const std::string& figures) {
  const std::filesystem::path result = std::filesystem::path(flight) / "result";
  std::filesystem::create_directory(result);
  std::ofstream(result / "new") << "{" << figures << ", \"unobservable\": [], \"point_sigmas\": "
                                << "{\"median_e_m\": 0.05, \"median_n_m\": 0.04, "
                                << "\"median_u_m\": 0.03}}";
  std::filesystem::rename(result / "new", result / "summary.json");
}

class MeasuringService : public MeasuringProcess {
 protected:
  Measurer& measurer() {
    options_.request_file = (folder_.path() / "request").string();
    return measurer_of("echo never");
  }
  // Whether it is asked for the flight, within five seconds.
  bool is_asked_for(const std::string& flight) {
    for (int k = 0; k < 100; ++k) {
      if (content_of(options_.request_file) == flight + "\n") return true;
      std::this_thread::sleep_for(50ms);
    }
    return false;
  }
};

TEST_F(MeasuringService, IsAskedByAFile) {
  options_.first_at = 1;
  measurer().stored("0001");
  EXPECT_TRUE(is_asked_for(flight()));
  EXPECT_FALSE(std::filesystem::exists(flight() + "/measure.log"));
}

TEST_F(MeasuringService, TellsItsResultsByWhatItLeavesInTheFlight) {
  write_result(flight(), "\"photos_used\": 2, \"photos_given\": 2");  // an old one
  Measurer& measurer = this->measurer();
  for (int photo = 1; photo <= 3; ++photo) measurer.stored("0001");
  ASSERT_TRUE(is_asked_for(flight()));
  std::this_thread::sleep_for(400ms);
  EXPECT_TRUE(said(0).empty()) << "what was there before it was asked";
  write_result(flight(), "\"photos_used\": 3, \"photos_given\": 3, \"converged\": true");
  const std::string report = flight() + "/result/report.html.";
  EXPECT_EQ(said(1).back(), "measured: Measured from 3 photos: " + report +
                                " Median sigma 5.0/4.0/3.0 cm east/north/up.");
  measurer.stored("0001");
  write_result(flight(), "\"photos_used\": 3, \"photos_given\": 4, \"converged\": false");
  EXPECT_THAT(said(2).back(), HasSubstr("failed: The adjustment did not converge"));
}

TEST_F(MeasuringService, IsSaidToBeSilentAndAskedAgainAfterLanding) {
  options_.longest = 1s;
  Measurer& measurer = this->measurer();
  for (int photo = 1; photo <= 3; ++photo) measurer.stored("0001");
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_THAT(said(1)[0],
              HasSubstr("No result came within 1 s of the request in " + options_.request_file));
  std::filesystem::remove(options_.request_file);
  std::this_thread::sleep_for(400ms);
  EXPECT_FALSE(std::filesystem::exists(options_.request_file));
  measurer.ended("0001");
  EXPECT_TRUE(is_asked_for(flight()));
  write_result(flight(), "\"photos_used\": 3, \"photos_given\": 3");
  EXPECT_THAT(said(2).back(), HasSubstr("measured: Measured from 3 photos"));
}

TEST_F(MeasuringService, IsAskedForAFlightThatWasLeft) {
  write_flight(flight(), 3, true);
  measurer().found({"0001", 3, false}, false);
  EXPECT_TRUE(is_asked_for(flight()));
  write_result(flight(), "\"photos_used\": 3, \"photos_given\": 3");
  EXPECT_THAT(said(2).back(), HasSubstr("left: Measured from 3 photos"));
}

}  // namespace
}  // namespace plumbline::service
