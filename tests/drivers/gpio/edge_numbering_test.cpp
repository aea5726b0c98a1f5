// SPDX-License-Identifier: MIT
#include "drivers/gpio/edge_numbering.h"

#include <gtest/gtest.h>

namespace plumbline::gpio {
namespace {

using namespace std::chrono_literals;

RawEdge edge(int at_ms, bool rising, std::optional<std::uint64_t> sequence = std::nullopt) {
  return {HostTime(std::chrono::milliseconds(at_ms)), rising, sequence};
}

std::uint64_t lost_in(const std::vector<LineEvent>& events) {
  std::uint64_t lost = 0;
  for (const LineEvent& event : events) {
    if (const auto* gap = std::get_if<EdgesLost>(&event)) lost += gap->count;
  }
  return lost;
}

TEST(EdgeNumbering, CountsOnWhereNothingIsMissing) {
  EdgeNumbering numbering;
  const auto events = numbering.number({edge(1, true), edge(2, false), edge(3, true)});
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(std::get<LineEdge>(events[2]).sequence, 2u);
}

TEST(EdgeNumbering, SeesByTheKernelsNumbersWhatWasLost) {
  EdgeNumbering numbering;
  EXPECT_EQ(lost_in(numbering.number({edge(1, true, 1), edge(2, false, 2)})), 0u);
  const auto events = numbering.number({edge(9, false, 6)});
  EXPECT_EQ(lost_in(events), 3u);
  EXPECT_EQ(std::get<LineEdge>(events.back()).sequence, 5u);
}

TEST(EdgeNumbering, SeesWithoutNumbersThatAnEdgeBetweenTwoAlikeIsMissing) {
  EdgeNumbering numbering;
  const auto events = numbering.number({edge(1, true), edge(5, true)});
  EXPECT_EQ(lost_in(events), 1u);
  EXPECT_EQ(std::get<LineEdge>(events.back()).sequence, 2u);
}

TEST(GpioLineName, IsAChipWithAnOffsetOrAName) {
  EXPECT_EQ(chip_and_offset("gpiochip0:17")->chip_path, "/dev/gpiochip0");
  EXPECT_EQ(chip_and_offset("gpiochip0:17")->offset, 17u);
  EXPECT_EQ(chip_and_offset("/dev/gpiochip1:0")->chip_path, "/dev/gpiochip1");
  for (const char* name : {"SHUTTER", "gpiochip0:", ":4", "gpiochip0:x", "gpiochip0:4x"})
    EXPECT_FALSE(chip_and_offset(name).has_value()) << name;
}

}  // namespace
}  // namespace plumbline::gpio
