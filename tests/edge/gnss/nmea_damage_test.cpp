// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "edge/gnss/nmea_parser.h"
#include "tests/edge/gnss/nmea_text.h"
#include "tests/edge/gnss/says_nothing_wrong.h"

namespace plumbline::gnss {
namespace {

// Two epochs of everything that is read.
std::string sample() {
  std::string log;
  log += sentence("GNZDA,100000.00,20,11,2026,00,00");
  log += sentence("GNRMC,100000.00,A,3540.1234567,N,13945.7654321,E,0.31,271.54,201126,,,D");
  log += sentence(
      "GNGGA,100000.00,3540.1234567,N,13945.7654321,E,4,17,1.0,52.140,M,38.123,M,1.2,0001");
  log += sentence("GNGST,100000.00,11.000,0.012,0.011,84.8,0.011,0.012,0.025");
  log += sentence("GPRMC,100000.20,A,3540.1234571,N,13945.7654377,E,0.31,271.54,201126,,,D");
  log += sentence(
      "GPGGA,100000.20,3540.1234571,N,13945.7654377,E,4,16,1.0,52.545,M,38.123,M,1.4,0001");
  log += sentence("GPGST,100000.20,11.000,0.014,0.013,84.8,0.013,0.014,0.031");
  return log;
}

TEST(NmeaParser, GivesNoWrongFixForAnyValueOfAnyOneByte) {
  const std::string good = sample();
  const std::vector<GnssFix> truth = parse(good).fixes;
  ASSERT_EQ(truth.size(), 2u);
  int wrong = 0;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int value = 0; value < 256; ++value) {
      std::string damaged = good;
      damaged[i] = static_cast<char>(value);
      for (const GnssFix& fix : parse(damaged).fixes) {
        if (says_nothing_wrong(fix, truth)) continue;
        ++wrong;
        ADD_FAILURE() << "byte " << i << " value " << value;
      }
    }
  }
  EXPECT_EQ(wrong, 0);
}

TEST(NmeaParser, DropsASentenceWithOneFlippedBit) {
  const std::string good = sentence(
      "GNGGA,100000.00,3540.1234567,N,13945.7654321,E,4,17,1.0,52.140,M,38.123,M,1.2,0001");
  const std::size_t body_end = good.find('*');
  for (std::size_t i = 1; i < body_end; ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = good;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      EXPECT_TRUE(parse(damaged).fixes.empty()) << i << " " << bit;
    }
  }
}

// Bytes lost from the middle can leave a text whose checksum holds by chance, more often than once
// in 256 times because digits share their upper bits: no parser can tell.
bool holds_a_forged_sentence(const std::string& damaged, const std::string& good) {
  bool forged = false;
  NmeaFramer framer([&](std::string_view body) {
    forged = forged || good.find(sentence(body)) == std::string::npos;
    return true;
  });
  framer.feed(damaged);
  framer.finish();
  return forged;
}

TEST(NmeaParser, GivesNoWrongFixForACutAnywhereUnlessTheChecksumHoldsByChance) {
  const std::string good = sample();
  const std::vector<GnssFix> truth = parse(good).fixes;
  int cuts = 0;
  int forged = 0;
  for (std::size_t from = 0; from < good.size(); ++from) {
    for (std::size_t length = 1; from + length <= good.size(); length += 3) {
      std::string damaged = good;
      damaged.erase(from, length);
      ++cuts;
      if (holds_a_forged_sentence(damaged, good)) {
        ++forged;
        continue;
      }
      for (const GnssFix& fix : parse(damaged).fixes) {
        EXPECT_TRUE(says_nothing_wrong(fix, truth)) << from << " " << length;
      }
    }
  }
  EXPECT_LT(forged, cuts / 50);
}

TEST(NmeaParser, GivesNoWrongFixForALogThatEndsOrBeginsAnywhere) {
  const std::string good = sample();
  const std::vector<GnssFix> truth = parse(good).fixes;
  for (std::size_t at = 0; at < good.size(); ++at) {
    for (const std::string& part : {good.substr(0, at), good.substr(at)}) {
      for (const GnssFix& fix : parse(part).fixes) {
        EXPECT_TRUE(says_nothing_wrong(fix, truth)) << at;
      }
    }
  }
}

TEST(NmeaParser, FindsEverySentenceBetweenBinaryMessages) {
  std::mt19937_64 random(20261120);
  std::string log;
  for (int i = 0; i < 200; ++i) {
    char time[16];
    std::snprintf(time, sizeof time, "1000%02d.%02d", i / 5 % 60, i % 5 * 20);
    log += sentence(std::string("GNGGA,") + time +
                    ",3540.1234567,N,13945.7654321,E,4,17,1.0,52.140,M,38.123,M,1.2,0001");
    log += "\xB5\x62";
    for (int k = 0; k < 90; ++k) log.push_back(static_cast<char>(random() & 0xFF));
  }
  const Parsed parsed = parse(log);
  EXPECT_EQ(parsed.counters.sentences, 200u);
  EXPECT_EQ(parsed.fixes.size(), 200u);
  // A random '$' with two capitals behind it is rare.
  EXPECT_LE(parsed.counters.malformed + parsed.counters.bad_checksum, 5u);
}

}  // namespace
}  // namespace plumbline::gnss
