// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <iostream>

#include "tests/edge/gnss/nmea_text.h"
#include "tests/edge/gnss/real_logs.h"
#include "tests/edge/gnss/says_nothing_wrong.h"

namespace plumbline::gnss {
namespace {

constexpr std::size_t kWindow = 1600;
constexpr std::size_t kWindows = 3;

// Every bit of every byte of a piece of a log; returns how many cases there were.
int flip_every_bit_of(const std::string& piece, const char* log) {
  const Parsed good = parse(piece);
  for (std::size_t i = 0; i < piece.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = piece;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      const Parsed parsed = parse(damaged);
      EXPECT_GE(parsed.counters.sentences + 1, good.counters.sentences) << log << " " << i;
      for (const GnssFix& fix : parsed.fixes) {
        EXPECT_TRUE(says_nothing_wrong(fix, good.fixes)) << log << " " << i << " bit " << bit;
      }
    }
  }
  return static_cast<int>(piece.size()) * 8;
}

class RealLogDamage : public testing::TestWithParam<const char*> {};

TEST_P(RealLogDamage, OfOneBitCostsAtMostItsSentence) {
  const auto path = real_logs() / GetParam();
  if (!std::filesystem::exists(path)) {
    std::cout << "no " << path << ": real receiver logs are not part of the repository\n";
    GTEST_SKIP() << "real receiver logs are not here";
  }
  const std::string log = contents(path);
  int cases = 0;
  for (std::size_t window = 0; window < kWindows && window * kWindow < log.size(); ++window) {
    cases += flip_every_bit_of(log.substr(window * kWindow, kWindow), GetParam());
  }
  std::cout << GetParam() << ": " << cases << " flipped bits\n";
}

INSTANTIATE_TEST_SUITE_P(Logs, RealLogDamage,
                         testing::Values("nmea-rtk.log", "ublox-f9p-hpnmea.log",
                                         "ublox-zed-f9p-nmea.log", "nmea-fuzzy-cases.log",
                                         "emlid_snippets.nmea"));

}  // namespace
}  // namespace plumbline::gnss
