// SPDX-License-Identifier: MIT
#include "firmware/deliver/labels.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace plumbline::deliver {
namespace {

using testing::HasSubstr;
using testing::Not;

TEST(Labels, StandBesideTheirPlacesAndMoveAsideForOthers) {
  Svg svg(100, 100, "");
  EXPECT_EQ(draw_labels(svg, {{50, 50}, {60, 44}}, {"A", "B"}), 0);
  const std::string drawn = svg.finish();
  EXPECT_THAT(drawn, HasSubstr(R"(x="45" y="45" class="label halo end">A<)"));
  EXPECT_THAT(drawn, HasSubstr(R"(x="65" y="39" class="label halo">B<)"));
}

TEST(Labels, ANameWithoutRoomIsLeftOutAndCounted) {
  Svg svg(100, 100, "");
  const std::vector<Place> crowd(5, Place(50, 50));
  EXPECT_EQ(draw_labels(svg, crowd, {"A1", "B1", "C1", "D1", "E1"}), 1);
  EXPECT_THAT(svg.finish(), Not(HasSubstr("E1")));
}

}  // namespace
}  // namespace plumbline::deliver
