// SPDX-License-Identifier: MIT
#include "drivers/posix/udp_stream.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/talk/udp_peer.h"

namespace plumbline::posix {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;
using Arrival = ByteStream::Arrival;
using Presence = ByteStream::Presence;

std::string free_port() { return std::to_string(talk::UdpPeer().port()); }

std::string read_from(UdpStream& stream) {
  const ByteStream::Reading reading = stream.read(seconds(2));
  EXPECT_EQ(reading.arrival, Arrival::kBytes) << reading.sentence;
  return std::string(reading.bytes);
}

TEST(UdpStream, AnswersToWhoeverSpokeLast) {
  const std::string port = free_port();
  UdpStream stream(UdpStream::Role::kListens, "127.0.0.1", port);
  ASSERT_EQ(stream.open().presence, Presence::kOpen);
  EXPECT_EQ(stream.write("is anybody there"), 0u);
  talk::UdpPeer first;
  talk::UdpPeer second;
  first.send_to(std::stoi(port), "first");
  EXPECT_EQ(read_from(stream), "first");
  EXPECT_EQ(stream.write("to the first"), 12u);
  EXPECT_EQ(first.receive(seconds(2)), "to the first");
  second.send_to(std::stoi(port), "second");
  EXPECT_EQ(read_from(stream), "second");
  EXPECT_EQ(stream.write("to the second"), 13u);
  EXPECT_EQ(second.receive(seconds(2)), "to the second");
  EXPECT_EQ(first.receive(milliseconds(0)), "");
}

TEST(UdpStream, SpeaksFirstWhereToldTo) {
  talk::UdpPeer peer;
  UdpStream stream(UdpStream::Role::kSpeaks, "127.0.0.1", std::to_string(peer.port()));
  ASSERT_EQ(stream.open().presence, Presence::kOpen);
  EXPECT_EQ(stream.write("hello"), 5u);
  EXPECT_EQ(peer.receive(seconds(2)), "hello");
  peer.send_to(peer.sender_port(), "good day");
  EXPECT_EQ(read_from(stream), "good day");
}

TEST(UdpStream, TakesNobodyAtTheFarEndForSilence) {
  UdpStream stream(UdpStream::Role::kSpeaks, "127.0.0.1", free_port());
  ASSERT_EQ(stream.open().presence, Presence::kOpen);
  for (int i = 0; i < 3; ++i) {
    stream.write("hello");
    EXPECT_EQ(stream.read(milliseconds(20)).arrival, Arrival::kNothing);
  }
}

TEST(UdpStream, TakesAnEmptyDatagramForNothing) {
  const std::string port = free_port();
  UdpStream stream(UdpStream::Role::kListens, "127.0.0.1", port);
  ASSERT_EQ(stream.open().presence, Presence::kOpen);
  talk::UdpPeer peer;
  peer.send_to(std::stoi(port), "");
  EXPECT_EQ(stream.read(seconds(1)).arrival, Arrival::kNothing);
  peer.send_to(std::stoi(port), "after it");
  EXPECT_EQ(read_from(stream), "after it");
}

TEST(UdpStream, IsRefusedAPortThatIsTaken) {
  talk::UdpPeer peer;
  UdpStream stream(UdpStream::Role::kListens, "127.0.0.1", std::to_string(peer.port()));
  const ByteStream::Opening opening = stream.open();
  EXPECT_EQ(opening.presence, Presence::kRefused);
  EXPECT_THAT(opening.sentence, testing::HasSubstr("taken by another program"));
}

TEST(UdpStream, IsRefusedAPortThatIsNoNumber) {
  UdpStream stream(UdpStream::Role::kSpeaks, "127.0.0.1", "no-such-port");
  EXPECT_EQ(stream.open().presence, Presence::kRefused);
}

}  // namespace
}  // namespace plumbline::posix
