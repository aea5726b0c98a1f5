// SPDX-License-Identifier: MIT
#include "firmware/ingest/named_points.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::ingest {
namespace {

using geodesy::Geodetic;
using geodesy::LocalFrame;
using ::testing::HasSubstr;
using ::testing::StartsWith;

const std::vector<std::string> kPhotos = {"0001.jpg", "0002.jpg", "climb_72.5"};

std::string picks_fault(const std::string& text) {
  const TemporaryFolder folder;
  const auto picks = read_picks(folder.write("picks.csv", text), kPhotos);
  return picks.ok() ? "" : picks.error().sentence;
}

TEST(Picks, FindTheirPhotoByNameWithOrWithoutEndingOrFolder) {
  const TemporaryFolder folder;
  const auto picks =
      read_picks(folder.write("picks.csv",
                              "point,v_px,u_px,photo,sigma_px\nA,2,1,0001.jpg,\nA,4,3,0002,0.2\n"
                              "B,6,5,photos/0002.jpg,\nB,8,7,climb_72.5,\nC,1,1,0001.JPG,\n"),
                 kPhotos);
  ASSERT_TRUE(picks.ok()) << picks.error().sentence;
  ASSERT_EQ(picks->picks.size(), 5u);
  EXPECT_EQ(picks->picks[0].photo, 0);
  EXPECT_EQ(picks->picks[0].pixel, Eigen::Vector2d(1, 2));
  EXPECT_FALSE(picks->picks[0].sigma_px);
  EXPECT_EQ(picks->picks[1].photo, 1);
  EXPECT_EQ(picks->picks[1].sigma_px, 0.2);
  EXPECT_EQ(picks->picks[2].photo, 1);
  EXPECT_EQ(picks->picks[3].photo, 2);
  EXPECT_EQ(picks->picks[4].photo, 0);
}

TEST(Picks, SayWhatIsWrongWithThem) {
  const std::string head = "photo,point,u_px,v_px,sigma_px\n";
  EXPECT_EQ(picks_fault(head + "0001.jpg,A,1,2,\n"), "");
  EXPECT_THAT(picks_fault("photo,point,u,v_px\n0001.jpg,A,1,2\n"),
              StartsWith("picks.csv:1: the column 'u_px' is missing"));
  EXPECT_THAT(picks_fault(head + "0003.jpg,A,1,2,\n"), HasSubstr("no photo '0003.jpg'"));
  EXPECT_THAT(picks_fault(head + "climb_72,A,1,2,\n"), HasSubstr("no photo 'climb_72'"));
  EXPECT_THAT(picks_fault(head + "0001.jpg,A,nan,2,\n"), StartsWith("picks.csv:2: 'u_px'"));
  EXPECT_THAT(picks_fault(head + "0001.jpg,A,1,2,\n0001,A,3,4,\n"),
              StartsWith("picks.csv:3: the point 'A' is there twice"));
  EXPECT_THAT(picks_fault(head + "0001.jpg,A,1,2,0\n"), HasSubstr("greater than 0"));
  EXPECT_THAT(picks_fault(head + "0001.jpg,A,1,2,-1\n"), HasSubstr("negative"));
  EXPECT_THAT(picks_fault(head + "0001.jpg,,1,2,\n"), HasSubstr("'point' is blank"));
  EXPECT_THAT(picks_fault(head), HasSubstr("no picks"));
}

TEST(Lengths, AreReadFromTheCommandLineAndFromAFile) {
  const auto plain = parse_length("A, B ,12.345");
  ASSERT_TRUE(plain.ok());
  EXPECT_EQ(plain->point_a, "A");
  EXPECT_EQ(plain->point_b, "B");
  EXPECT_EQ(plain->metres, 12.345);
  EXPECT_EQ(plain->sigma_m, kLengthSigmaM);
  EXPECT_EQ(parse_length("A,B,12.345,0.002")->sigma_m, 0.002);
  for (const char* bad : {"A,B", "A,B,x", "A,A,3", "A,B,-3", "A,B,3,-1", "A,B,3,1,1", ",B,3",
                          "A,B,nan", "", "A,B,3,"}) {
    EXPECT_FALSE(parse_length(bad).ok()) << bad;
  }
  const TemporaryFolder folder;
  const auto read = read_lengths(
      folder.write("lengths.csv", "point_a,point_b,length_m,sigma_m\nA,B,5,\nA,C,6,0.01\n"));
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->lengths[1].sigma_m, 0.01);
  const auto twice =
      read_lengths(folder.write("lengths.csv", "point_a,point_b,length_m\nA,B,5\nB,A,6\n"));
  ASSERT_FALSE(twice.ok());
  EXPECT_THAT(twice.error().sentence, StartsWith("lengths.csv:3: "));
}

// 30.922 m of longitude and 30.822 m of latitude to the second at 36 degrees... by hand: the point
// is one second of arc north of the origin, M(36) * 1" = 30.8218 m on GRS80.
TEST(KnownPoints, OnTheEarthAreTurnedIntoTheLocalFrame) {
  const TemporaryFolder folder;
  const auto frame = LocalFrame::at({36, 139 + 50 / 60., 100});
  const auto known = read_known_points(
      folder.write("control.csv",
                   "point,lat_deg,lon_deg,height_ellipsoidal_m,sigma_e_m,sigma_n_m,sigma_u_m,e_m,"
                   "n_m,u_m\nA,36.0002777777778,139.833333333333,102,0.01,0.01,0.02,9,9,9\n"
                   "B,,,,,,,1,2,3\n"),
      {&*frame, nullptr});
  ASSERT_TRUE(known.ok()) << known.error().sentence;
  EXPECT_NEAR(known->points[0].in_enu_m.x(), 0, 1e-4);
  EXPECT_NEAR(known->points[0].in_enu_m.y(), 30.8218, 2e-3);
  EXPECT_NEAR(known->points[0].in_enu_m.z(), 2, 1e-4);
  EXPECT_EQ(known->points[1].in_enu_m, Eigen::Vector3d(1, 2, 3));
  EXPECT_FALSE(known->points[1].sigma_m);
  const auto control = as_control(*known);
  EXPECT_NEAR(control[0].covariance_m2(2, 2), 4e-4, 1e-12);
  EXPECT_NEAR(control[1].covariance_m2(0, 0), kControlSigmaM * kControlSigmaM, 1e-15);
  EXPECT_EQ(as_check_points(*known)[1].sigma_m, Eigen::Vector3d::Zero());
}

TEST(KnownPoints, OfAPlaneRectangularZoneHaveXToTheNorth) {
  const TemporaryFolder folder;
  const auto frame = LocalFrame::at({36, 139 + 50 / 60., 0});
  const auto known = read_known_points(
      folder.write(
          "check.csv",
          "point,x_north_m,y_east_m,zone,height_ellipsoidal_m\nA,100,0,IX,0\nB,0,50,9,1\n"),
      {&*frame, nullptr});
  ASSERT_TRUE(known.ok()) << known.error().sentence;
  EXPECT_NEAR(known->points[0].in_enu_m.y(), 100 / 0.9999, 1e-3);
  EXPECT_NEAR(known->points[0].in_enu_m.x(), 0, 1e-6);
  EXPECT_NEAR(known->points[1].in_enu_m.x(), 50 / 0.9999, 1e-3);
}

std::string isg_of_40_m() {
  std::string text =
      "begin_of_head =\nlat min = 35\nlat max = 37\nlon min = 139\nlon max = 141\n"
      "delta lat = 1\ndelta lon = 1\nnrows = 3\nncols = 3\nend_of_head =\n";
  for (int i = 0; i < 9; ++i) text += "40.0 ";
  return text;
}

TEST(KnownPoints, WithOrthometricHeightsNeedTheGeoid) {
  const TemporaryFolder folder;
  const auto path =
      folder.write("check.csv", "point,lat_deg,lon_deg,height_orthometric_m\nA,36,139.5,60\n");
  const auto frame = LocalFrame::at({36, 139.5, 0});
  const auto without = read_known_points(path, {&*frame, nullptr});
  ASSERT_FALSE(without.ok());
  EXPECT_THAT(without.error().sentence, HasSubstr("--geoid"));
  const std::string isg = isg_of_40_m();
  const auto geoid = geodesy::Geoid::parse(
      {reinterpret_cast<const std::uint8_t*>(isg.data()), isg.size()}, "g.isg");
  ASSERT_TRUE(geoid.ok()) << geoid.error().sentence;
  const auto with = read_known_points(path, {&*frame, &*geoid});
  ASSERT_TRUE(with.ok());
  EXPECT_NEAR(with->points[0].in_enu_m.z(), 100, 1e-6);
  const auto place = first_place(path, &*geoid);
  ASSERT_TRUE(place.ok());
  EXPECT_NEAR((*place)->height_ellipsoidal_m, 100, 1e-9);
}

TEST(KnownPoints, SayWhatIsWrongWithThem) {
  const TemporaryFolder folder;
  const auto fault = [&folder](const std::string& text, bool framed) {
    const auto frame = LocalFrame::at({36, 139, 0});
    const auto known =
        read_known_points(folder.write("control.csv", text), {framed ? &*frame : nullptr, nullptr});
    return known.ok() ? "" : known.error().sentence;
  };
  const std::string enu = "point,e_m,n_m,u_m\n";
  EXPECT_EQ(fault(enu + "A,1,2,3\n", true), "");
  EXPECT_EQ(fault(enu + "A,1,2,3\n", false), "");
  EXPECT_THAT(fault(enu + "A,1,2,\n", false), HasSubstr("not complete"));
  EXPECT_THAT(fault(enu + "A,1,2,3\nA,1,2,3\n", false), StartsWith("control.csv:3: "));
  EXPECT_THAT(fault("point,e_m,n_m\nA,1,2\n", false), HasSubstr("columns of a position"));
  EXPECT_THAT(fault(enu, false), HasSubstr("no points"));
  const std::string geodetic = "point,lat_deg,lon_deg,height_ellipsoidal_m\n";
  EXPECT_THAT(fault(geodetic + "A,36,139,0\n", false), HasSubstr("on the earth"));
  EXPECT_THAT(fault(geodetic + "A,96,139,0\n", true), HasSubstr("not a place"));
  EXPECT_THAT(fault("point,x_north_m,y_east_m,zone,height_ellipsoidal_m\nA,0,0,XX,0\n", true),
              HasSubstr("'XX'"));
  EXPECT_THAT(fault("point,e_m,n_m,u_m,sigma_u_m\nA,1,2,3,0.1\n", true), HasSubstr("all three"));
}

}  // namespace
}  // namespace plumbline::ingest
