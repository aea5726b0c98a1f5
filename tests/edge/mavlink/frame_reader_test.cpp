// SPDX-License-Identifier: MIT
#include "edge/mavlink/frame_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

#include "edge/mavlink/checksum.h"
#include "tests/edge/mavlink/frames_read.h"
#include "tests/edge/mavlink/reference_frames.h"
#include "tests/talk/pilot_talk.h"

namespace plumbline::mavlink {
namespace {

using talk::from_hex;

std::vector<std::uint32_t> ids_of(const FramesRead& read) {
  std::vector<std::uint32_t> ids;
  for (const Frame& frame : read.frames) ids.push_back(frame.id);
  return ids;
}

TEST(Checksum, OfTheUsualNineDigitsIsThePublishedOne) {
  Checksum checksum;
  checksum.add("123456789");
  EXPECT_EQ(checksum.value(), 0x6F91);
}

TEST(Definitions, HaveTheExtraAndTheLengthsThatThePublishedTextGives) {
  for (const char* name : {"HEARTBEAT", "ATTITUDE", "GLOBAL_POSITION_INT", "STATUSTEXT"}) {
    const talk::PublishedMessage& message = talk::published(name);
    const Definition* definition = find_definition(message.id);
    ASSERT_NE(definition, nullptr) << name;
    EXPECT_EQ(definition->crc_extra, talk::crc_extra_of(message)) << name;
    EXPECT_EQ(definition->length_v1, talk::length_of(message, false)) << name;
    EXPECT_EQ(definition->length_full, talk::length_of(message, true)) << name;
  }
  EXPECT_EQ(find_definition(2), nullptr);
}

TEST(FrameReader, ReadsTheFramesOfAnotherImplementation) {
  const FramesRead read =
      read_frames(from_hex(reference::kHeartbeat) + from_hex(reference::kAttitudeV1) +
                  from_hex(reference::kPosition));
  ASSERT_EQ(read.frames.size(), 3u);
  EXPECT_EQ(read.frames[0].version, 2);
  EXPECT_EQ(read.frames[0].sequence, 200);
  EXPECT_EQ(read.frames[0].system_id, 1);
  EXPECT_EQ(read.frames[0].component_id, 1);
  EXPECT_EQ(read.frames[0].id, kHeartbeat);
  EXPECT_EQ(read.frames[1].version, 1);
  EXPECT_EQ(read.frames[1].sequence, 11);
  EXPECT_EQ(read.frames[1].id, kAttitude);
  EXPECT_EQ(read.frames[2].id, kGlobalPositionInt);
  EXPECT_EQ(read.counters.frames, 3u);
  EXPECT_EQ(read.counters.garbage_bytes, 0u);
}

TEST(FrameReader, WritesThemAgainByteForByte) {
  for (const char* hex : {reference::kHeartbeat, reference::kHeartbeatV1, reference::kAttitude,
                          reference::kAttitudeV1, reference::kPosition, reference::kPositionV1,
                          reference::kPositionCut, reference::kOwnHeartbeat, reference::kOwnText}) {
    const FramesRead read = read_frames(from_hex(hex));
    ASSERT_EQ(read.frames.size(), 1u) << hex;
    EXPECT_EQ(bytes_of(read.frames[0]), from_hex(hex)) << hex;
  }
}

TEST(FrameReader, FillsUpTheZerosThatWereLeftOut) {
  const FramesRead read = read_frames(from_hex(reference::kPositionCut));
  ASSERT_EQ(read.frames.size(), 1u);
  EXPECT_EQ(read.frames[0].payload.size(), 28u);
  EXPECT_EQ(read.frames[0].payload.substr(12), std::string(16, '\0'));
}

TEST(FrameReader, TakesASignedFrameAndCountsTheSignature) {
  const FramesRead read =
      read_frames(from_hex(reference::kHeartbeatSigned) + from_hex(reference::kHeartbeat));
  ASSERT_EQ(read.frames.size(), 2u);
  EXPECT_EQ(read.frames[0].payload, read.frames[1].payload);
  EXPECT_EQ(read.counters.signed_frames, 1u);
  EXPECT_EQ(read.counters.garbage_bytes, 0u);
}

TEST(FrameReader, SkipsWhatItDoesNotKnowByItsLength) {
  // Its payload holds a whole heartbeat, which is not to be taken for one.
  const std::string unknown = talk::pilot_frame(12345, 77, from_hex(reference::kHeartbeat));
  const FramesRead read =
      read_frames(from_hex(reference::kSystemTime) + unknown + from_hex(reference::kAttitude));
  EXPECT_THAT(ids_of(read), testing::ElementsAre(kAttitude));
  EXPECT_EQ(read.counters.unknown, 2u);
  EXPECT_EQ(read.counters.bad_checksum, 0u);
  EXPECT_EQ(read.counters.garbage_bytes, 0u);
}

TEST(FrameReader, LeavesAFrameWithAFlagThatItDoesNotUnderstand) {
  const std::string strange =
      talk::vehicle_heartbeat(true, {.sequence = 9, .incompatibility_flags = 2});
  const FramesRead read = read_frames(strange + from_hex(reference::kAttitude));
  EXPECT_THAT(ids_of(read), testing::ElementsAre(kAttitude));
  EXPECT_EQ(read.counters.incompatible, 1u);
}

TEST(FrameReader, TakesExtensionFieldsThatCameLater) {
  const talk::PublishedMessage& attitude = talk::published("ATTITUDE");
  const std::string longer =
      talk::pilot_frame(attitude.id, talk::crc_extra_of(attitude), std::string(40, '\1'));
  const FramesRead read = read_frames(longer);
  ASSERT_EQ(read.frames.size(), 1u);
  EXPECT_EQ(read.frames[0].payload.size(), 40u);
}

TEST(FrameReader, TakesExtensionFieldsInMavlink1ButNoShorterPayload) {
  EXPECT_THAT(ids_of(read_frames(from_hex(reference::kOwnTextV1))),
              testing::ElementsAre(kStatusText));
  const talk::PublishedMessage& attitude = talk::published("ATTITUDE");
  const FramesRead read = read_frames(talk::pilot_frame(attitude.id, talk::crc_extra_of(attitude),
                                                        std::string(12, '\1'), {.version = 1}));
  EXPECT_TRUE(read.frames.empty());
  EXPECT_EQ(read.counters.malformed, 1u);
}

TEST(FrameReader, GivesTheSameFramesInPiecesOfAnySize) {
  const std::string stream = sample_stream();
  const FramesRead whole = read_frames(stream);
  ASSERT_EQ(whole.frames.size(), 8u);
  for (std::size_t piece = 1; piece < 60; ++piece) {
    EXPECT_TRUE(same(read_frames(stream, piece).frames, whole.frames)) << piece;
  }
}

TEST(FrameReader, FindsEveryFrameBetweenGarbage) {
  std::mt19937_64 random(20261120);
  std::string stream;
  for (int i = 0; i < 500; ++i) {
    // Often a start mark, so that many a false frame begins and reaches into a true one.
    for (int k = 0; k < 40; ++k) {
      stream += random() % 8 == 0 ? '\xFD' : static_cast<char>(random() & 0xFF);
    }
    stream += talk::vehicle_attitude(i, 1.5, {.sequence = i & 0xFF});
  }
  const FramesRead read = read_frames(stream);
  EXPECT_GT(read.counters.bad_checksum, 1000u);
  // What begins like a frame of an unknown kind passes once in 256 times, and reaches over at most
  // five of these.
  EXPECT_LE(read.frames.size(), 500u);
  EXPECT_GE(read.frames.size() + 5 * read.counters.unknown, 500u);
  EXPECT_LT(read.counters.unknown, read.counters.bad_checksum / 64);
}

TEST(FrameReader, FindsAFrameBehindAFalseStartWhenNothingMoreComes) {
  const std::string false_start = "\xFD\xFF";
  FramesRead read;
  FrameReader reader([&](const Frame& frame) { read.frames.push_back(frame); });
  reader.feed(false_start + from_hex(reference::kHeartbeat));
  EXPECT_TRUE(read.frames.empty());
  reader.flush();
  EXPECT_EQ(read.frames.size(), 1u);
  EXPECT_EQ(reader.counters().garbage_bytes, 2u);
}

TEST(FrameReader, JoinsNothingAcrossACut) {
  const std::string frame = from_hex(reference::kAttitude);
  for (std::size_t at = 1; at < frame.size(); ++at) {
    FramesRead read;
    FrameReader reader([&](const Frame& got) { read.frames.push_back(got); });
    reader.feed(frame.substr(0, at));
    reader.cut();
    reader.feed(frame.substr(at));
    reader.flush();
    EXPECT_TRUE(read.frames.empty()) << at;
    EXPECT_EQ(reader.counters().garbage_bytes, frame.size());
  }
}

}  // namespace
}  // namespace plumbline::mavlink
