// SPDX-License-Identifier: MIT
#include "firmware/config/config_toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "firmware/config/config_text.h"

namespace plumbline::config {
namespace {

using std::chrono::microseconds;
using std::chrono::milliseconds;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

ConfigReading parsed(const std::string& text) { return parse_config(text, "p.toml"); }

std::vector<std::string> faults(const std::string& text) {
  std::vector<std::string> sentences;
  for (const Error& error : parsed(text).errors) sentences.push_back(error.sentence);
  return sentences;
}

Config good(const std::string& text) {
  EXPECT_THAT(faults(text), IsEmpty());
  return parsed(text).config;
}

TEST(ConfigToml, AnEmptyFileSaysTheDefaults) {
  EXPECT_EQ(config_text(good("")), config_text(Config()));
  EXPECT_EQ(good("").capture.plan.heights_m, capture::CapturePlan().heights_m);
}

TEST(ConfigToml, ValuesArriveInTheirUnits) {
  const Config config = good(
      "[receiver]\naddress = \"tcp://10.0.0.2:9001\"\nlatency_s = 0.065\n"
      "[camera]\nlongest_exposure_ms = 0.5\nrow_time_us = 18.904\nwidth_px = 4056\n"
      "[release]\nby = \"pulse\"\nline = \"gpiochip0:17\"\npulse_ms = 50\ndelay_s = 0.12\n"
      "[measure]\nseconds = 60\n");
  EXPECT_EQ(config.receiver.address, "tcp://10.0.0.2:9001");
  EXPECT_EQ(config.capture.receiver_latency.value, milliseconds(65));
  EXPECT_EQ(config.camera.options.longest_exposure, microseconds(500));
  EXPECT_EQ(config.camera.options.row_time, std::chrono::nanoseconds(18904));
  EXPECT_EQ(config.camera.options.width_px, 4056);
  EXPECT_EQ(config.capture.release.release, capture::Release::kPulse);
  EXPECT_EQ(config.trigger.pulse, milliseconds(50));
  EXPECT_EQ(config.capture.release.delay, milliseconds(120));
  EXPECT_EQ(config.measure.longest, std::chrono::seconds(60));
}

TEST(ConfigToml, HeightsFollowFromFirstLastAndStep) {
  const Config config = good("[capture]\nfirst_m = 10\nlast_m = 60\nstep_m = 12.5\n");
  EXPECT_THAT(config.capture.plan.heights_m, ElementsAre(10, 22.5, 35, 47.5, 60));
}

TEST(ConfigToml, TheLastHeightIsReachedInStepsThatBinaryDigitsRound) {
  const Config config = good("[capture]\nfirst_m = 30\nlast_m = 31\nstep_m = 0.1\n");
  ASSERT_EQ(config.capture.plan.heights_m.size(), 11U);
  EXPECT_NEAR(config.capture.plan.heights_m.back(), 31, 1e-9);
}

TEST(ConfigToml, AListOfHeightsStandsInsteadOfSteps) {
  const Config config = good("[capture]\nheights_m = [12, 30.5, 80]\nstep_m = 1\n");
  EXPECT_THAT(config.capture.plan.heights_m, ElementsAre(12, 30.5, 80));
}

TEST(ConfigToml, ZeroMeansNoneAndAutoLeavesItToTheCamera) {
  const Config config = good(
      "[capture]\naside_m = 0\nblind_every_s = 0\nevery_s = 10\n"
      "[camera]\ngain = \"auto\"\nlens_position_dioptre = 0\n");
  EXPECT_FALSE(config.capture.plan.aside_m);
  EXPECT_FALSE(config.capture.plan.blind_every);
  EXPECT_EQ(config.capture.plan.every, std::chrono::seconds(10));
  EXPECT_FALSE(config.camera.options.fixed_gain);
  EXPECT_EQ(config.camera.options.lens_position_dioptre, 0.0);
}

TEST(ConfigToml, AMisspeltKeyIsToldWithTheOneThatWasMeant) {
  EXPECT_THAT(faults("[receiver]\nadress = \"/dev/ttyS0\"\n"),
              ElementsAre("p.toml:2: 'adress' is no key of [receiver]; did you mean 'address'?"));
}

TEST(ConfigToml, AMisspeltSectionIsToldWithTheOneThatWasMeant) {
  EXPECT_THAT(faults("\n[reciever]\naddress = \"/dev/ttyS0\"\n"),
              ElementsAre("p.toml:2: [reciever] is no section; did you mean [receiver]?"));
}

TEST(ConfigToml, AKeyOfAnotherSectionIsSentThere) {
  EXPECT_THAT(faults("[receiver]\ngoal_m = 0.1\n"),
              ElementsAre("p.toml:2: 'goal_m' is no key of [receiver]; put it under [advice]."));
  EXPECT_THAT(faults("goal_m = 0.1\n"),
              ElementsAre("p.toml:1: 'goal_m' stands outside of any section; put it under "
                          "[advice]."));
  EXPECT_THAT(faults("[receiver]\nby = \"pulse\"\n"),
              ElementsAre(HasSubstr("put it under [release] or [take_off].")));
}

TEST(ConfigToml, AKeyLikeNoOtherIsSentToTheExample) {
  EXPECT_THAT(faults("[receiver]\nfrobnicate = 1\n"),
              ElementsAre("p.toml:2: 'frobnicate' is no key of [receiver]; plumbline config "
                          "--example lists them all."));
}

TEST(ConfigToml, AValueOutOfItsRangeIsToldWithTheRange) {
  EXPECT_THAT(faults("[receiver]\nlatency_s = 80\n"),
              ElementsAre("p.toml:2: latency_s wants a number of seconds from 0 to 2, not 80."));
}

TEST(ConfigToml, AValueOfTheWrongKindIsToldWithTheRightOne) {
  EXPECT_THAT(
      faults("[receiver]\nlatency_s = \"80 ms\"\n"),
      ElementsAre(HasSubstr("latency_s wants a number of seconds from 0 to 2, not \"80 ms")));
  EXPECT_THAT(faults("[camera]\nfixed_exposure = 1\n"),
              ElementsAre("p.toml:2: fixed_exposure wants true or false, not 1."));
  EXPECT_THAT(faults("[camera]\njpeg_quality = 90.5\n"),
              ElementsAre(HasSubstr("wants a whole number from 50 to 100, not 90.5.")));
  EXPECT_THAT(faults("[capture]\ndirection = \"sideways\"\n"),
              ElementsAre(HasSubstr("wants \"up\", \"down\" or \"both\", not \"sideways\".")));
  EXPECT_THAT(faults("receiver = 1\n"), ElementsAre(HasSubstr("write [receiver] in a line")));
}

TEST(ConfigToml, NumbersThatAreNoneAreRefused) {
  for (const char* number : {"nan", "inf", "-inf", "1e400", "-0.001", "9223372036854775807"}) {
    EXPECT_EQ(faults("[receiver]\nlatency_s = " + std::string(number) + "\n").size(), 1U) << number;
  }
}

TEST(ConfigToml, HeightsThatDoNotAscendAreRefused) {
  for (const char* list :
       {"[30, 30]", "[40, 30]", "[0.5, 2]", "[30, 6000]", "[30, nan]", "30", "[\"30\"]"}) {
    EXPECT_EQ(faults("[capture]\nheights_m = " + std::string(list) + "\n").size(), 1U) << list;
  }
}

TEST(ConfigToml, EveryFaultIsToldInTheOrderOfTheFile) {
  const auto told = faults(
      "[status]\nfile = \"here\"\n[camera]\ngane = 2\n[capture]\nfirst_m = 90\nlast_m = 30\n"
      "[nowhere]\n");
  ASSERT_EQ(told.size(), 4U);
  EXPECT_THAT(told[0], testing::StartsWith("p.toml:2: file wants a path"));
  EXPECT_THAT(told[1], testing::StartsWith("p.toml:4: 'gane'"));
  EXPECT_THAT(told[2], testing::StartsWith("p.toml:7: last_m (30 m) lies below first_m (90 m)"));
  EXPECT_THAT(told[3], testing::StartsWith("p.toml:8: [nowhere]"));
}

TEST(ConfigToml, WhatIsNotTomlIsToldWithItsLine) {
  EXPECT_THAT(faults("[receiver]\naddress = /dev/ttyACM0\n"),
              ElementsAre(testing::StartsWith("p.toml:2: not valid TOML (")));
  EXPECT_THAT(faults("[advice]\ngoal_m = 0.1\ngoal_m = 0.2\n"),
              ElementsAre(testing::StartsWith("p.toml:3: not valid TOML (")));
  EXPECT_THAT(faults("[)receiver]\n"),
              ElementsAre(testing::StartsWith("p.toml:1: not valid TOML (")));
}

TEST(ConfigToml, WhatIsWrongLeavesItsDefaultAndTheRestCounts) {
  const ConfigReading reading =
      parsed("[capture]\nfirst_m = -3\nlast_m = 50\n[advice]\ngoal = 1\n");
  EXPECT_EQ(reading.errors.size(), 2U);
  EXPECT_THAT(reading.config.capture.plan.heights_m, ElementsAre(30, 35, 40, 45, 50));
}

TEST(ConfigToml, DeepNestingIsRefusedAndNotFollowed) {
  std::string deep = "[a";
  for (int i = 0; i < 30'000; ++i) deep += ".a";
  EXPECT_EQ(faults(deep + "]\n").size(), 1U);
  EXPECT_EQ(faults("a = " + std::string(30'000, '[')).size(), 1U);
}

TEST(ConfigToml, LettersOfAllLanguagesStandInQuotesAndCommentsOnly) {
  EXPECT_EQ(good("[receiver]\ndatum = \"\u6e2c\u5730\" # \u00b5\n").receiver.datum, "\u6e2c\u5730");
  EXPECT_EQ(good("[receiver]\ndatum = '\\ \u00b5'\n").receiver.datum, "\\ \u00b5");
  EXPECT_THAT(faults("[receiver]\n\u00b5 = 1\n"),
              ElementsAre(testing::StartsWith("p.toml:2: a character that is not ASCII")));
  EXPECT_THAT(faults("[receiver]\ndatum = \"\" \u00b5\n"),
              ElementsAre(testing::StartsWith("p.toml:2: a character that is not ASCII")));
}

TEST(ConfigToml, TextOverSeveralLinesIsRefused) {
  EXPECT_THAT(faults("[receiver]\ndatum = \"\"\"\na\"\"\"\n"),
              ElementsAre(testing::StartsWith("p.toml:2: no key wants text over several lines")));
}

TEST(ConfigToml, AFileThatIsNotThereIsAnError) {
  const auto reading = read_config("/nowhere/plumbline.toml");
  ASSERT_FALSE(reading);
  EXPECT_THAT(reading.error().sentence, HasSubstr("plumbline.toml"));
}

}  // namespace
}  // namespace plumbline::config
