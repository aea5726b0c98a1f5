// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/edge/mavlink/frames_read.h"

namespace plumbline::mavlink {
namespace {

// How many of `got` are not among the true frames.
std::ptrdiff_t wrong_ones(const std::vector<Frame>& got, const std::vector<Frame>& truth) {
  return std::count_if(got.begin(), got.end(), [&](const Frame& frame) {
    return std::none_of(truth.begin(), truth.end(),
                        [&](const Frame& true_one) { return same(frame, true_one); });
  });
}

TEST(FrameReader, GivesNoWrongFrameForAnyOneFlippedBitAndLosesOneAtMost) {
  const std::string good = sample_stream();
  const std::vector<Frame> truth = read_frames(good).frames;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int bit = 0; bit < 8; ++bit) {
      std::string damaged = good;
      damaged[i] = static_cast<char>(damaged[i] ^ (1 << bit));
      const std::vector<Frame> got = read_frames(damaged).frames;
      EXPECT_EQ(wrong_ones(got, truth), 0) << i << " " << bit;
      EXPECT_GE(got.size() + 1, truth.size()) << i << " " << bit;
    }
  }
}

TEST(FrameReader, GivesNoWrongFrameForAnyValueOfAnyOneByte) {
  const std::string good = sample_stream();
  const std::vector<Frame> truth = read_frames(good).frames;
  for (std::size_t i = 0; i < good.size(); ++i) {
    for (int value = 0; value < 256; ++value) {
      std::string damaged = good;
      damaged[i] = static_cast<char>(value);
      EXPECT_EQ(wrong_ones(read_frames(damaged).frames, truth), 0) << i << " " << value;
    }
  }
}

// A checksum of 16 bits holds by chance once in 65536 times.
TEST(FrameReader, GivesHardlyAWrongFrameForACutAnywhere) {
  const std::string good = sample_stream();
  const std::vector<Frame> truth = read_frames(good).frames;
  std::ptrdiff_t wrong = 0;
  int cuts = 0;
  for (std::size_t from = 0; from < good.size(); ++from) {
    for (std::size_t length = 1; from + length <= good.size(); length += 3) {
      std::string damaged = good;
      damaged.erase(from, length);
      wrong += wrong_ones(read_frames(damaged).frames, truth);
      ++cuts;
    }
  }
  EXPECT_GT(cuts, 10000);
  EXPECT_LE(wrong, 3);
}

}  // namespace
}  // namespace plumbline::mavlink
