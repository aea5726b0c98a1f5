// SPDX-License-Identifier: MIT
// The measuring process is a shell script that stands for plumbline.
#include "firmware/service/measurer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <condition_variable>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <vector>

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
      keep("measured: " + measured.sentence +
           (measured.figures ? " " + in_words(*measured.figures) : ""));
    };
    events.failed = [this](const std::string& sentence) { keep("failed: " + sentence); };
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

TEST_F(MeasuringProcess, IsAskedForByAFileWhereAServiceRunsIt) {
  options_.first_at = 1;
  options_.request_file = (folder_.path() / "request").string();
  Measurer& measurer = measurer_of("echo never");
  measurer.stored("0001");
  for (int k = 0; k < 100 && content_of(options_.request_file).empty(); ++k) {
    std::this_thread::sleep_for(50ms);
  }
  EXPECT_EQ(content_of(options_.request_file), flight() + "\n");
  EXPECT_FALSE(std::filesystem::exists(flight() + "/measure.log"));
}

}  // namespace
}  // namespace plumbline::service
