// SPDX-License-Identifier: MIT
// Ten photos of a real climb, with EXIF positions good to several metres.
#include <gmock/gmock.h>

#include <cstdlib>

#include "tests/firmware/commands/acceptance/flight_folder.h"

namespace plumbline::acceptance {
namespace {

class RealClimb : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    if (PLUMBLINE_SANITIZED) GTEST_SKIP() << "12-megapixel photos take too long under sanitizers";
    const char* shared = std::getenv("PLUMBLINE_SHARED");
    climb = fs::absolute(shared != nullptr ? shared : PLUMBLINE_SHARED_BESIDE) / "data/climb";
    if (!fs::is_directory(climb)) GTEST_SKIP() << "no photos in " << climb;
  }

  // The figures that independent software finds on these photos, with room for what they leave
  // open: nominal focal length 2917 px.
  void expect_measured(std::vector<std::string> arguments, int photos) {
    arguments.insert(arguments.begin(), "measure");
    arguments.insert(arguments.end(), {"--out", "result"});
    const Outcome outcome = run_plumbline(arguments, folder);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const Json summary = summary_of(folder / "result");
    EXPECT_EQ(summary["photos_used"], photos);
    EXPECT_LE(summary["reprojection_rms_px"].get<double>(), 0.6);
    EXPECT_GE(summary["tie_points_3plus"].get<int>(), 300);
    EXPECT_GT(summary["focal_length_px"].get<double>(), 2700);
    EXPECT_LT(summary["focal_length_px"].get<double>(), 3150);
    EXPECT_GT(summary["sigma_focal_length_px"].get<double>(), 10);
    const std::string relative = lines_of(summary["relative_only"]);
    EXPECT_THAT(relative, testing::HasSubstr("Scale"));
    EXPECT_THAT(relative, testing::HasSubstr("Position"));
    EXPECT_TRUE(fs::exists(folder / "result/report.html"));
  }

  fs::path climb;
};

TEST_F(RealClimb, OfTenPhotosIsMeasured) { expect_measured({climb.string()}, 10); }

TEST_F(RealClimb, OfFivePhotosIsMeasured) {
  std::vector<std::string> first;
  for (int i = 9354; i <= 9358; ++i) {
    first.push_back((climb / ("IMG_" + std::to_string(i) + ".jpg")).string());
  }
  expect_measured(first, 5);
}

}  // namespace
}  // namespace plumbline::acceptance
