// SPDX-License-Identifier: MIT
// `plumbline orient` against truth from an independent forward model.
#include <gmock/gmock.h>

#include <cmath>

#include "tests/firmware/commands/acceptance/flight_folder.h"
#include "tests/firmware/commands/acceptance/made_case.h"

namespace plumbline::acceptance {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::Not;

// Wilson and Hilferty 1931; `z` of the standard normal distribution.
double chi_square_quantile(double z, double dof) {
  const double a = 2 / (9 * dof);
  return dof * std::pow(1 - a + z * std::sqrt(a), 3);
}

class Orient : public FolderTest {
 protected:
  Json solved(const CasePlan& plan, const std::string& name = "case") {
    write_case(plan, folder / name);
    const Outcome outcome = run_plumbline({"orient", name}, folder);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.err, "");
    return summary_of(folder / name / "result");
  }

  // The joint test at 99.9 % two-sided.
  static void expect_within_covariance(const Json& summary) {
    ASSERT_TRUE(summary.contains("check"));
    const Json& check = summary["check"];
    const double dof = check["joint_nees_dof"].get<double>();
    EXPECT_GE(dof, 60);
    EXPECT_GT(check["joint_nees"].get<double>(), chi_square_quantile(-3.29, dof));
    EXPECT_LT(check["joint_nees"].get<double>(), chi_square_quantile(3.29, dof));
    EXPECT_EQ(summary["converged"], true);
  }

  static std::vector<std::string> unobservable(const Json& summary) {
    return summary["unobservable"].get<std::vector<std::string>>();
  }
};

TEST_F(Orient, ReproducesTruthWithinItsCovarianceOverThirtyFlights) {
  double nees = 0, dof = 0, within_one = 0, within_two = 0;
  for (unsigned seed = 1; seed <= 30; ++seed) {
    const Json summary = solved({.seed = seed}, "case" + std::to_string(seed));
    expect_within_covariance(summary);
    EXPECT_THAT(unobservable(summary), Not(Contains("azimuth")));
    nees += summary["check"]["joint_nees"].get<double>();
    dof += summary["check"]["joint_nees_dof"].get<double>();
    within_one += summary["check"]["share_within_one_sigma"].get<double>() / 30;
    within_two += summary["check"]["share_within_two_sigma"].get<double>() / 30;
  }
  EXPECT_GT(nees, chi_square_quantile(-3.29, dof));
  EXPECT_LT(nees, chi_square_quantile(3.29, dof));
  EXPECT_GT(within_one, 0.60);
  EXPECT_LT(within_one, 0.76);
  EXPECT_GT(within_two, 0.91);
}

TEST_F(Orient, ListsTheDifferencesOfEveryCheckPoint) {
  solved({.seed = 41});
  const auto known = rows_of(folder / "case/check.csv");
  const auto checked = rows_of(folder / "case/result/check.csv");
  auto points = rows_of(folder / "case/result/points.csv");
  ASSERT_EQ(checked.size(), known.size());
  for (std::size_t i = 0; i < known.size(); ++i) {
    for (auto& point : points) {
      if (point["point"] != known[i].at("point")) continue;
      EXPECT_NEAR(std::stod(point["e_m"]) - std::stod(known[i].at("e_m")),
                  std::stod(checked[i].at("difference_e_m")), 2e-6);
    }
  }
}

TEST_F(Orient, TakesTheLeverArmOffTheAntenna) {
  const Json summary = solved({.seed = 42, .lever_arm_m = {0.12, -0.3, 0.25}});
  expect_within_covariance(summary);
}

// Straight up with one compass the level stays weak (a degree), so that the joint test, which
// supposes small angles, is left aside here: sigmas of single coordinates must still hold.
TEST_F(Orient, UsesHeadingsWhereThereIsNoSideStep) {
  EXPECT_THAT(unobservable(solved({.seed = 60, .side_step_m = 0}, "without")), Contains("azimuth"));
  double within_two = 0;
  for (unsigned seed = 60; seed < 70; ++seed) {
    const Json with = solved({.seed = seed, .side_step_m = 0, .heading_sigma_deg = 2},
                             "with" + std::to_string(seed));
    within_two += with["check"]["share_within_two_sigma"].get<double>() / 10;
    const double sigma_deg = with["common_sigmas"]["azimuth_deg"].get<double>();
    EXPECT_LT(sigma_deg, 2.05) << "one compass for all photos, at least as good as it is";
    EXPECT_GT(sigma_deg, 1.5) << "one compass, not five";
  }
  EXPECT_GT(within_two, 0.8);
}

TEST_F(Orient, UsesControlInsteadOfStations) {
  const Json summary = solved({.seed = 44, .stations = false, .control = true});
  expect_within_covariance(summary);
  EXPECT_THAT(unobservable(summary), Not(Contains("position")));
  EXPECT_THAT(unobservable(summary), Not(Contains("scale")));
}

TEST_F(Orient, ComparesNothingWhereAllCheckPointsAreControl) {
  write_case({.seed = 48, .stations = false, .control = true}, folder / "case");
  write_text(folder / "case/check.csv", text_of(folder / "case/control.csv"));
  const Outcome outcome = run_plumbline({"orient", "case"}, folder);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const Json summary = summary_of(folder / "case/result");
  EXPECT_FALSE(summary.contains("check") && summary["check"].is_object());
  EXPECT_THAT(summary["warnings"].dump(), testing::HasSubstr("All check points were control"));
}

TEST_F(Orient, TakesItsScaleFromALengthAlone) {
  const Json summary = solved({.seed = 45, .stations = false, .length = true});
  EXPECT_THAT(unobservable(summary), AllOf(Contains("position"), Contains("azimuth")));
  EXPECT_THAT(unobservable(summary), Not(Contains("scale")));
  EXPECT_EQ(summary["check"]["same_frame"], false);
  EXPECT_LT(summary["check"]["best_fit_rmse_e_m"].get<double>(), 0.05);
}

TEST_F(Orient, SaysThatWithoutAnyMeasureThereIsNoScale) {
  const Json summary = solved({.seed = 46, .stations = false});
  EXPECT_THAT(unobservable(summary), AllOf(Contains("position"), Contains("scale")));
}

TEST_F(Orient, AddsACommonOffsetToEveryPositionAlike) {
  const Json without = solved({.seed = 47}, "without");
  const Json with = solved({.seed = 47, .offset_sigma_m = 0.5}, "with");
  expect_within_covariance(with);
  EXPECT_THAT(unobservable(with), Contains("gnss_offset"));
  const auto sigma_m = [](const Json& summary) {
    return summary["common_sigmas"]["position_m"].get<double>();
  };
  EXPECT_NEAR(sigma_m(with), std::hypot(sigma_m(without), 0.5), 0.01);
}

class BadCase : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write_case({.seed = 50}, folder / "case");
  }
  void expect_bad(const std::string& sentence) {
    expect_refused({"orient", "case", "--out", "result"}, sentence);
    write_case({.seed = 50}, folder / "case");
  }
  void expect_bad(const std::string& file, const std::string& text, const std::string& sentence) {
    write_text(folder / "case" / file, text);
    expect_bad(sentence);
    fs::remove_all(folder / "case");
    write_case({.seed = 50}, folder / "case");
  }
};

TEST_F(BadCase, WithoutAFileThatIsNeededIsRefused) {
  for (const std::string file : {"camera.toml", "photos.csv", "observations.csv"}) {
    fs::remove(folder / "case" / file);
    expect_bad(file);
  }
  expect_refused({"orient", "nowhere"}, "'nowhere' is not a folder");
}

TEST_F(BadCase, WithAnEmptyFileIsRefused) {
  for (const std::string file : {"camera.toml", "photos.csv", "observations.csv", "check.csv",
                                 "control.csv", "lengths.csv", "lever_arm.csv"}) {
    expect_bad(file, "", file);
  }
}

TEST_F(BadCase, WithAWrongTableIsRefusedWithFileAndLine) {
  const std::string head = "photo,point,u_px,v_px\nphoto0.jpg,P0,100,100\n";
  expect_bad("observations.csv", "photo,point,u,v_px\n", "observations.csv:1: ");
  expect_bad("observations.csv", head + "photo9.jpg,P0,1,1\n", "observations.csv:3: ");
  expect_bad("observations.csv", head + "photo0.jpg,P0,1,1\n", "observations.csv:3: ");
  expect_bad("observations.csv", head + "photo1.jpg,P0,nan,1\n", "observations.csv:3: ");
  expect_bad("observations.csv", head + "photo1.jpg,P0,inf,1\n", "observations.csv:3: ");
  expect_bad("observations.csv", head + "photo1.jpg,P0,90000,1\n", "observations.csv:3: ");
  expect_bad("photos.csv", "photo,e_m,n_m,u_m\nphoto0.jpg,0,0,70\n", "photos.csv:2: ");
  expect_bad("photos.csv", "photo\nphoto0.jpg\nphoto0.jpg\n", "photos.csv:3: ");
  expect_bad("check.csv", "point,e_m,n_m,u_m\nP0,0,0,0\nP0,0,0,0\n", "check.csv:3: ");
  expect_bad("check.csv", "point,e_m,n_m,u_m\nZZ,0,0,0\n", "check points");
  expect_bad("lengths.csv", "point_a,point_b,length_m\nP0,ZZ,5\n", "'ZZ'");
  expect_bad("lengths.csv", "point_a,point_b,length_m\nP0,P1,0\n", "lengths.csv:2: ");
  expect_bad("lever_arm.csv", "right_m,up_m,back_m\n0,0,nan\n", "lever_arm.csv:2: ");
  expect_bad("gnss.toml", "offset_sigma_m = [1]\n", "gnss.toml:1: ");
  expect_bad("gnss.toml", "offset_sigma_m = [1, -1]\n", "gnss.toml:1: ");
  expect_bad("camera.toml", "width_px = \n", "camera.toml:1: ");
  expect_bad("camera.toml", "width_px = 4000\nheight_px = 2250\nfocal_length_px = nan\n",
             "camera.toml:3: ");
}

TEST_F(BadCase, WithTooLittleToGoOnIsRefused) {
  expect_bad("photos.csv", "photo\nphoto0.jpg\n", "photo");
  expect_bad("observations.csv", "photo,point,u_px,v_px\nphoto0.jpg,P0,100,100\n", "");
  expect_bad("observations.csv",
             "photo,point,u_px,v_px\nphoto0.jpg,P0,9,9\nphoto1.jpg,P0,9,9\nphoto0.jpg,P1,99,9\n"
             "photo1.jpg,P1,99,9\n",
             "");
}

}  // namespace
}  // namespace plumbline::acceptance
