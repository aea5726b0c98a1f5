// SPDX-License-Identifier: MIT
#include "firmware/service/status_board.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace plumbline::service {
namespace {

using ::testing::HasSubstr;
using ::testing::Not;

capture::Decision phase(capture::Phase phase) {
  return {HostTime{}, capture::PhaseChanged{phase, 50.0}};
}

TEST(StatusBoard, SaysWhatIsMissingWhileItWaits) {
  StatusBoard board;
  EXPECT_THAT(board.sentence(), HasSubstr("Waiting for a position"));
  capture::FixHeard heard;
  heard.fix.quality = FixQuality::kFixed;
  board.heard({HostTime{}, heard});
  EXPECT_THAT(board.sentence(), HasSubstr("Waiting for the camera"));
}

TEST(StatusBoard, SaysInFlightThatThereIsNoCamera) {
  StatusBoard board;
  board.decided(phase(capture::Phase::kFlying));
  EXPECT_THAT(board.sentence(), HasSubstr("No camera"));
  board.heard({HostTime{}, capture::CameraSeen{true}});
  EXPECT_THAT(board.sentence(), Not(HasSubstr("No camera")));
  StatusBoard of_pulses(false);
  of_pulses.decided(phase(capture::Phase::kFlying));
  EXPECT_THAT(of_pulses.sentence(), Not(HasSubstr("No camera")));
}

TEST(StatusBoard, IsNotReadyWhereTheDiskHasNoRoomForTheFlight) {
  StatusBoard board;
  board.decided(phase(capture::Phase::kReady));
  board.space(14, 14);
  EXPECT_THAT(board.sentence(), HasSubstr("Ready: "));
  EXPECT_THAT(board.sentence(), HasSubstr("14 photos fit"));
  board.space(13, 14);
  EXPECT_THAT(board.sentence(), HasSubstr("Not ready: the disk has room for 13 photos of 14"));
  EXPECT_THAT(board.sentence(), HasSubstr("move old flights"));
  EXPECT_EQ(nlohmann::json::parse(board.json())["planned_photos"], 14);
}

TEST(StatusBoard, SaysWhichHeightsHaveNoPhotoUntilTheyHave) {
  StatusBoard board;
  board.decided(phase(capture::Phase::kFlying));
  board.decided({HostTime{}, capture::HeightPassed{{capture::Reason::kHeight, 3, 45}}});
  board.decided({HostTime{}, capture::HeightPassed{{capture::Reason::kHeight, 4, 47.5}}});
  EXPECT_THAT(board.sentence(), HasSubstr("No photo at 45 m, 47.5 m: fly there again."));
  capture::PhotoTaken taken;
  taken.target = {capture::Reason::kHeight, 3, 45};
  board.decided({HostTime{}, taken});
  EXPECT_THAT(board.sentence(), HasSubstr("No photo at 47.5 m:"));
  board.decided(phase(capture::Phase::kLanded));
  EXPECT_THAT(board.sentence(), HasSubstr("No photo at 47.5 m."));
}

TEST(StatusBoard, CountsThePhotosOfTheFlightAndShowsThemAsJson) {
  StatusBoard board;
  board.decided(phase(capture::Phase::kFlying));
  capture::PhotoTaken taken;
  taken.number = 1;
  taken.marks.late = true;
  board.decided({HostTime{}, taken});
  board.stored(1, "0001");
  const auto json = nlohmann::json::parse(board.json());
  EXPECT_EQ(json["photos_taken"], 1);
  EXPECT_EQ(json["photos_stored"], 1);
  EXPECT_EQ(json["photos_marked"], 1);
  EXPECT_EQ(json["phase"], "flying");
  EXPECT_EQ(json["flight"], "0001");
}

TEST(StatusBoard, ShowsTroubleUntilItIsOver) {
  StatusBoard board;
  board.said({HostTime{}, record::Severity::kFault, "disk", "The disk is full."});
  EXPECT_THAT(board.sentence(), HasSubstr("The disk is full."));
  board.said({HostTime{}, record::Severity::kInfo, "disk", "It takes what is written again."});
  EXPECT_THAT(board.sentence(), Not(HasSubstr("full")));
}

}  // namespace
}  // namespace plumbline::service
