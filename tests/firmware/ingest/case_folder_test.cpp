// SPDX-License-Identifier: MIT
#include "firmware/ingest/case_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>

#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::ingest {
namespace {

using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

constexpr double kRad = M_PI / 180;
using Files = std::map<std::string, std::string>;

Files good_case() {
  return {
      {"camera.toml", "width_px = 4000\nheight_px = 3000\nfocal_length_px = 3000.0\n"},
      {"photos.csv",
       "photo,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m,cov_en_m2,cov_eu_m2,cov_nu_m2,ve_m_s,vn_m_"
       "s,"
       "vu_m_s,omega_deg,phi_deg,kappa_deg,sigma_omega_deg,sigma_phi_deg,sigma_kappa_deg,"
       "heading_deg,sigma_heading_deg,time_s\n"
       "1,0,0,70,0.01,0.01,0.02,1e-5,0,0,0.1,0.2,2.5,1,2,,0.5,0.5,,10,2,0\n"
       "2,0.5,0.1,75,0.01,0.01,0.02,,,,,,,,,,,,,,,2\n"
       "3,,,,,,,,,,,,,,,,,,,,,4\n"},
      {"observations.csv",
       "photo,point,u_px,v_px,sigma_px\n1,A,100,200,0.3\n2,A,110,210,\n3,A,120,220,\n1,B,300,400,\n"
       "2,B,310,410,0.2\n1,C,500,600,\n3,C,510,610,\n"},
      {"lengths.csv", "point_a,point_b,length_m,sigma_m\nA,B,12.5,0.002\n"},
      {"control.csv", "point,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m\nC,1,2,3,0.01,0.02,0.03\n"},
      {"check.csv", "point,e_m,n_m,u_m\nB,4,5,6\nZ,7,8,9\n"},
      {"frame.csv", "role,point\norigin,A\nx_axis,B\nplane,C\n"},
      {"lever_arm.csv", "right_m,up_m,back_m\n0.01,-0.02,0.15\n"},
      {"gnss.toml",
       "offset_sigma_m = [3.0, 5.0]\ncorrelation_s = 30\ncorrelated_sigma_m = [1, 2.0]\n"}};
}

Result<CaseFolder> read(const Files& files) {
  const TemporaryFolder folder;
  for (const auto& [name, text] : files) folder.write(name, text);
  return read_case(folder.path(), nullptr);
}

std::string fault(const std::string& file, const std::string& text) {
  Files files = good_case();
  files[file] = text;
  const auto read_back = read(files);
  return read_back.ok() ? "" : read_back.error().sentence;
}

TEST(CaseFolder, IsReadWithEverythingThatItMayHold) {
  const auto result = read(good_case());
  ASSERT_TRUE(result.ok()) << result.error().sentence;
  EXPECT_THAT(result->warnings, IsEmpty());
  const orient::Problem& problem = result->problem;
  ASSERT_EQ(problem.photos.size(), 3u);
  const orient::Photo& first = problem.photos[0];
  EXPECT_EQ(first.station->antenna_in_enu_m, Eigen::Vector3d(0, 0, 70));
  EXPECT_NEAR(first.station->covariance_m2(0, 0), 1e-4, 1e-15);
  EXPECT_NEAR(first.station->covariance_m2(1, 0), 1e-5, 1e-15);
  EXPECT_EQ(*first.velocity_in_enu_m_s, Eigen::Vector3d(0.1, 0.2, 2.5));
  EXPECT_NEAR(first.attitude->omega_phi_kappa_rad[1], 2 * kRad, 1e-15);
  EXPECT_NEAR(first.attitude->sigma_rad[0], 0.5 * kRad, 1e-15);
  EXPECT_TRUE(std::isinf(first.attitude->sigma_rad[2]));
  EXPECT_NEAR(first.heading->heading_rad, 10 * kRad, 1e-15);
  EXPECT_FALSE(problem.photos[1].attitude || problem.photos[1].heading);
  EXPECT_FALSE(problem.photos[2].station);
  EXPECT_EQ(problem.photos[2].time_s, 4);
  EXPECT_THAT(problem.point_names, ElementsAre("A", "B", "C"));
  ASSERT_EQ(problem.observations.size(), 7u);
  EXPECT_EQ(problem.observations[0].group, orient::ImageGroup::kStated);
  EXPECT_EQ(problem.observations[0].sigma_px, 0.3);
  EXPECT_EQ(problem.observations[1].group, orient::ImageGroup::kPicks);
  EXPECT_EQ(problem.observations[1].sigma_px, 1);
  ASSERT_EQ(problem.lengths.size(), 1u);
  EXPECT_EQ(problem.lengths[0].point_b, 1);
  ASSERT_EQ(problem.control.size(), 1u);
  EXPECT_EQ(problem.control[0].point, 2);
  EXPECT_NEAR(problem.control[0].covariance_m2(2, 2), 9e-4, 1e-15);
  ASSERT_EQ(result->check.size(), 2u);
  EXPECT_EQ(result->check[1].point, "Z");
  EXPECT_EQ(result->frame_roles->plane, 2);
  EXPECT_EQ(problem.lever_arm.in_photo_m, Eigen::Vector3d(0.01, -0.02, 0.15));
  EXPECT_EQ(problem.gnss.offset_sigma_vertical_m, 5);
  EXPECT_EQ(problem.gnss.correlated_sigma_horizontal_m, 1);
  EXPECT_EQ(problem.gnss.correlation_s, 30);
  EXPECT_EQ(result->input_sha256.size(), 9u);
  EXPECT_FALSE(result->frame);
}

TEST(CaseFolder, NeedsOnlyThreeFiles) {
  Files files = good_case();
  for (const char* optional :
       {"lengths.csv", "control.csv", "check.csv", "frame.csv", "lever_arm.csv", "gnss.toml"}) {
    files.erase(optional);
  }
  EXPECT_TRUE(read(files).ok());
  for (const char* required : {"camera.toml", "photos.csv", "observations.csv"}) {
    Files less = files;
    less.erase(required);
    const auto result = read(less);
    ASSERT_FALSE(result.ok());
    EXPECT_THAT(result.error().sentence, HasSubstr(required));
  }
}

TEST(CaseFolder, SaysInOneSentenceWithTheLineWhatIsWrong) {
  const std::string observations = "photo,point,u_px,v_px\n1,A,1,2\n";
  EXPECT_THAT(fault("observations.csv", observations + "9,A,1,2\n"),
              StartsWith("observations.csv:3: there is no photo '9'"));
  EXPECT_THAT(fault("observations.csv", observations + "1,A,1,2\n"),
              StartsWith("observations.csv:3: the point 'A' is there twice"));
  EXPECT_THAT(fault("observations.csv", observations + "2,A,NaN,2\n"),
              StartsWith("observations.csv:3: 'u_px' is 'NaN'"));
  EXPECT_THAT(fault("observations.csv", observations + "2,A,1e6,2\n"), HasSubstr("far outside"));
  EXPECT_THAT(fault("observations.csv", "photo,name,u_px,v_px\n1,A,1,2\n"),
              StartsWith("observations.csv:1: the column 'point' is missing"));
  EXPECT_THAT(fault("observations.csv", "photo,point,u_px,v_px\n"), HasSubstr("no observations"));
  EXPECT_THAT(fault("observations.csv", ""), HasSubstr("empty"));
  EXPECT_THAT(fault("photos.csv", "photo\n1\n1\n"), StartsWith("photos.csv:3: "));
  EXPECT_THAT(fault("photos.csv", "photo,e_m,n_m,u_m\n1,0,0,70\n"), HasSubstr("sigma_e_m"));
  EXPECT_THAT(fault("photos.csv",
                    "photo,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m\n1,0,0,70,0.1,-0.1,0.1\n"),
              HasSubstr("negative"));
  EXPECT_THAT(
      fault("photos.csv", "photo,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m\n1,0,,70,1,1,1\n"),
      HasSubstr("all three of e_m"));
  EXPECT_THAT(fault("photos.csv",
                    "photo,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m,cov_en_m2,cov_eu_m2,"
                    "cov_nu_m2\n1,0,0,70,0.1,0.1,0.1,0.02,0,0\n"),
              HasSubstr("correlation of 1"));
  EXPECT_THAT(fault("photos.csv", "photo,heading_deg\n1,10\n"), HasSubstr("sigma_heading_deg"));
  EXPECT_THAT(fault("lengths.csv", "point_a,point_b,length_m\nA,Q,1\n"), HasSubstr("'Q'"));
  EXPECT_THAT(fault("lengths.csv", "point_a,point_b,length_m\nA,B,0\n"),
              StartsWith("lengths.csv:2: "));
  EXPECT_THAT(fault("frame.csv", "role,point\norigin,A\n"), HasSubstr("x_axis"));
  EXPECT_THAT(fault("frame.csv", "role,point\norigin,A\nx_axis,A\nplane,C\n"),
              HasSubstr("three different"));
  EXPECT_THAT(fault("frame.csv", "role,point\nmiddle,A\n"), HasSubstr("'middle'"));
  EXPECT_THAT(fault("lever_arm.csv", "right_m,up_m,back_m\n"), HasSubstr("one row"));
  EXPECT_THAT(fault("lever_arm.csv", "right_m,up_m,back_m\n0,0,1500\n"), HasSubstr("100 m"));
  EXPECT_THAT(fault("gnss.toml", "offset_sigma_m = 3\n"), StartsWith("gnss.toml:1: "));
  EXPECT_THAT(fault("gnss.toml", "offset_sigma_m = [3, -1]\n"), HasSubstr("0 or more"));
  EXPECT_THAT(fault("gnss.toml", "offset_sigma_m = [nan, 1]\n"), HasSubstr("finite"));
  EXPECT_THAT(fault("gnss.toml", "correlated_sigma_m = [1, 1]\n"), HasSubstr("correlation_s"));
  EXPECT_THAT(fault("gnss.toml", "="), HasSubstr("not valid TOML"));
  EXPECT_THAT(fault("check.csv", "point,lat_deg,lon_deg,height_ellipsoidal_m\nA,36,139,0\n"),
              HasSubstr("on the earth"));
  const auto missing = read_case("/nowhere/at/all", nullptr);
  ASSERT_FALSE(missing.ok());
  EXPECT_THAT(missing.error().sentence, HasSubstr("is not a folder"));
}

TEST(CaseFolder, WarnsOfWhatItLeavesOut) {
  Files files = good_case();
  files["control.csv"] += "Q,1,1,1,0.1,0.1,0.1\n";
  files["check.csv"] = "point,e_m,n_m,u_m,colour\nB,4,5,6,red\n";
  files["gnss.toml"] += "offest = 1\n";
  const auto result = read(files);
  ASSERT_TRUE(result.ok());
  EXPECT_EQ(result->problem.control.size(), 1u);
  EXPECT_THAT(result->warnings, Contains(HasSubstr("'Q' is seen in no photo")));
  EXPECT_THAT(result->warnings, Contains(HasSubstr("'colour'")));
  EXPECT_THAT(result->warnings, Contains(HasSubstr("'offest'")));
}

TEST(CaseFolder, SaysWhichAnglesHaveNoSigma) {
  Files files = good_case();
  files["photos.csv"] =
      "photo,omega_deg,phi_deg,kappa_deg,sigma_kappa_deg\n1,1,,3,0.5\n2,1,,3,\n3,,,,\n";
  const auto result = read(files);
  ASSERT_TRUE(result.ok()) << result.error().sentence;
  EXPECT_THAT(result->warnings, ElementsAre(AllOf(StartsWith("photos.csv: omega_deg of 2 photos"),
                                                  HasSubstr("sigma_omega_deg")),
                                            StartsWith("photos.csv: kappa_deg of 1 photo ")));
  EXPECT_TRUE(std::isinf(result->problem.photos[0].attitude->sigma_rad[0]));
  EXPECT_NEAR(result->problem.photos[0].attitude->sigma_rad[2], 0.5 * kRad, 1e-15);
  EXPECT_FALSE(result->problem.photos[1].attitude);
}

TEST(CaseFolder, SaysThatAllPhotosHaveOnePosition) {
  Files files = good_case();
  files.erase("gnss.toml");
  files["photos.csv"] =
      "photo,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m\n1,0,0,70,1,1,1\n2,0,0,70,1,1,1\n3,,,,,,\n";
  EXPECT_THAT(read(files)->warnings, ElementsAre(HasSubstr("one and the same position")));
  files["photos.csv"].replace(files["photos.csv"].find("2,0,0,70"), 8, "2,0,0,71");
  EXPECT_THAT(read(files)->warnings, IsEmpty());
}

TEST(CaseFolder, SaysNothingFalseOfAFileWithAHeaderOnly) {
  Files files = good_case();
  files["lengths.csv"] = "point_a,point_b,length_m,sigma_m\n";
  const auto result = read(files);
  ASSERT_TRUE(result.ok()) << result.error().sentence;
  EXPECT_THAT(result->warnings, ElementsAre("lengths.csv: there are no lengths in it."));
  const std::string points = "point,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m\n";
  EXPECT_THAT(fault("control.csv", points), HasSubstr("there are no points in it"));
  EXPECT_THAT(fault("check.csv", points), HasSubstr("there are no points in it"));
  EXPECT_THAT(fault("frame.csv", "role,point\n"), HasSubstr("each of the roles"));
}

TEST(CaseFolder, IsPlacedOnTheEarthByControlWhereThePhotosAreNotPlacedAtAll) {
  Files files = good_case();
  files["photos.csv"] = "photo\n1\n2\n3\n";
  files.erase("gnss.toml");
  files["control.csv"] =
      "point,lat_deg,lon_deg,height_ellipsoidal_m\nA,36,139,50\nB,36.0001,139,51\n";
  const auto result = read(files);
  ASSERT_TRUE(result.ok()) << result.error().sentence;
  ASSERT_TRUE(result->frame);
  EXPECT_EQ(result->frame->origin().height_ellipsoidal_m, 50);
  EXPECT_NEAR(result->problem.control[0].in_enu_m.norm(), 0, 1e-9);
  EXPECT_NEAR(result->problem.control[1].in_enu_m.y(), 11.096, 0.001);
  EXPECT_THAT(result->warnings, Contains(HasSubstr("states no sigma")));
}

std::string damaged(std::string text, std::mt19937& random) {
  static const char* const kPieces[] = {"nan", "-", ",",    "\n", "1e308",        "\"",
                                        "inf", "0", "\xFF", "[",  "999999999999", "="};
  for (auto times = 1 + random() % 4; times > 0; --times) {
    const std::size_t at = random() % (text.size() + 1);
    switch (random() % 4) {
      case 0:
        text.insert(at, kPieces[random() % 12]);
        break;
      case 1:
        text.erase(at, random() % 10);
        break;
      case 2:
        if (at < text.size()) text[at] = static_cast<char>(random() % 256);
        break;
      default:
        text.resize(at);
        break;
    }
  }
  return text;
}

TEST(CaseFolder, SurvivesAnyDamage) {
  const TemporaryFolder folder;
  const Files whole = good_case();
  for (const auto& [name, text] : whole) folder.write(name, text);
  std::mt19937 random(23);
  int read_anyway = 0;
  for (int trial = 0; trial < 1500; ++trial) {
    auto victim = whole.begin();
    std::advance(victim, static_cast<long>(random() % whole.size()));
    folder.write(victim->first, damaged(victim->second, random));
    const auto result = read_case(folder.path(), nullptr);
    if (result.ok()) {
      ++read_anyway;
      for (const auto& o : result->problem.observations) EXPECT_TRUE(o.pixel.allFinite());
    } else {
      EXPECT_FALSE(result.error().sentence.empty());
    }
    folder.write(victim->first, victim->second);
  }
  EXPECT_GT(read_anyway, 0);
}

}  // namespace
}  // namespace plumbline::ingest
