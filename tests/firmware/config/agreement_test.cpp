// SPDX-License-Identifier: MIT
#include "firmware/config/agreement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "firmware/config/config_toml.h"

namespace plumbline::config {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

// The only fault of a file; empty where there is none or more than one.
std::string fault(const std::string& text) {
  const ConfigReading reading = parse_config(text, "p.toml");
  return reading.errors.size() == 1 ? reading.errors[0].sentence : "";
}

TEST(Agreement, TheDefaultsAgree) {
  Config config;
  EXPECT_TRUE(settle(config).empty());
}

TEST(Agreement, APulseNeedsALine) {
  EXPECT_THAT(fault("[release]\nby = \"pulse\"\n"), StartsWith("p.toml:2: by = \"pulse\" needs"));
  EXPECT_EQ(parse_config("[release]\nby = \"pulse\"\n", "").config.capture.release.release,
            capture::Release::kNearestFrame);
}

TEST(Agreement, WithoutACameraHereAPulseIsNeeded) {
  const std::string none = "[camera]\nid = \"none\"\n";
  EXPECT_THAT(fault(none), StartsWith("p.toml:2: without a camera here nothing takes a photo"));
  const std::string pulse = "[release]\nby = \"pulse\"\nline = \"SHUTTER\"\n";
  EXPECT_TRUE(parse_config(none + pulse, "").errors.empty());
  EXPECT_THAT(fault(none + "[release]\nby = \"pulse\"\n"),
              StartsWith("p.toml:4: by = \"pulse\" needs"));
}

TEST(Agreement, APilotWhoArmsNeedsALink) {
  EXPECT_THAT(fault("[take_off]\nby = \"pilot\"\n"), StartsWith("p.toml:2: by = \"pilot\" needs"));
  EXPECT_TRUE(
      parse_config("[take_off]\nby = \"pilot\"\n[pilot]\nlink = \"udp://0.0.0.0:14550\"\n", "")
          .errors.empty());
}

TEST(Agreement, OneLineIsNotBothOutputAndInput) {
  EXPECT_THAT(fault("[release]\nline = \"SHUTTER\"\nfeedback_line = \"SHUTTER\"\n"),
              StartsWith("p.toml:3: line and feedback_line are the same"));
}

TEST(Agreement, FeedbackThatTellsNothingIsAContradiction) {
  EXPECT_THAT(fault("[release]\nanswered = false\nfeedback_line = \"HOTSHOE\"\n"),
              StartsWith("p.toml:2: answered = false"));
}

TEST(Agreement, ADelayIsNotLongerThanTheLongest) {
  EXPECT_THAT(fault("[release]\ndelay_s = 1.5\n"), StartsWith("p.toml:2: delay_s is longer"));
}

TEST(Agreement, ALandingLiesBelowATakeOff) {
  EXPECT_THAT(fault("[take_off]\nrise_m = 1\n"), StartsWith("p.toml:2: landed_below_m (2 m)"));
}

TEST(Agreement, TooManyHeightsAreNotPhotographed) {
  EXPECT_THAT(fault("[capture]\nlast_m = 5000\nstep_m = 0.1\n"),
              HasSubstr("more than 500 photos; write a larger step_m"));
  Heights many{.list_m = {}, .first_m = 1, .last_m = 500, .step_m = 1};
  EXPECT_EQ(heights_of(many).size(), 500U);
}

}  // namespace
}  // namespace plumbline::config
