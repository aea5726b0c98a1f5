// SPDX-License-Identifier: MIT
#include "firmware/ingest/tie_table.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::ingest {
namespace {

using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<std::string> kPhotos = {"0001.jpg", "0002.jpg"};
const std::string kHead = "photo,point,u_px,v_px,sigma_px,residual_u_px,residual_v_px,used\n";

TEST(Ties, OfAnEarlierResultAreItsPointsWithoutThoseNamedNow) {
  const TemporaryFolder folder;
  const auto ties =
      read_ties(folder.write("observations.csv",
                             kHead + "0002.jpg,T1,3,4,0.5,0,0,1\n0001.jpg,P1,5,6,0.1,0,0,1\n"
                                     "0001.jpg,T1,1,2,0.2,0,0,1\n0001.jpg,T2,7,8,0.2,9,9,0\n"),
                kPhotos, {"P1"});
  ASSERT_TRUE(ties.ok()) << ties.error().sentence;
  EXPECT_EQ(ties->point_count, 2);
  ASSERT_EQ(ties->observations.size(), 3u);
  EXPECT_EQ(ties->observations[0].photo, 0);
  EXPECT_EQ(ties->observations[0].pixel, Eigen::Vector2d(1, 2));
  EXPECT_DOUBLE_EQ(ties->observations[0].covariance_px2(1, 1), 0.04);
  EXPECT_EQ(ties->observations[1].photo, 1);
  EXPECT_EQ(ties->observations[1].point, ties->observations[0].point);
  EXPECT_NE(ties->observations[2].point, ties->observations[0].point);
}

TEST(Ties, SayWhatIsWrongWithThem) {
  const auto fault = [](const std::string& text) {
    const TemporaryFolder folder;
    const auto ties = read_ties(folder.write("observations.csv", text), kPhotos, {"P1"});
    return ties.ok() ? "" : ties.error().sentence;
  };
  EXPECT_THAT(fault("photo,point,u_px,v_px\n"), HasSubstr("'sigma_px' is missing"));
  EXPECT_THAT(fault(kHead + "0003.jpg,T1,1,2,0.2,0,0,1\n"),
              StartsWith("observations.csv:2: there is no photo '0003.jpg'"));
  EXPECT_THAT(fault(kHead + "0001.jpg,T1,1,2,0,0,0,1\n"), HasSubstr("greater than 0"));
  EXPECT_THAT(fault(kHead + "0001.jpg,T1,nan,2,1,0,0,1\n"), HasSubstr("'u_px'"));
  EXPECT_THAT(fault(kHead + "0001.jpg,P1,1,2,1,0,0,1\n"), HasSubstr("no tie points"));
}

}  // namespace
}  // namespace plumbline::ingest
