// SPDX-License-Identifier: MIT
// frame.csv and `plumbline orient CASE --paper`, against truth from an independent forward model.
#include <gmock/gmock.h>

#include <Eigen/Geometry>
#include <cmath>

#include "tests/firmware/commands/acceptance/flight_folder.h"
#include "tests/firmware/commands/acceptance/made_case.h"

namespace plumbline::acceptance {
namespace {

using testing::Contains;
using testing::HasSubstr;
using testing::Not;

class Frame : public FolderTest {
 protected:
  // A case whose check.csv is in the frame of three of its points, far apart, Z up.
  void write_framed_case(const CasePlan& plan) {
    const MadeCase made = write_case(plan, folder / "case");
    const auto furthest = [&](double east, double north) {
      std::size_t best = 0;
      for (std::size_t p = 1; p < made.points.size(); ++p) {
        const Eigen::Vector3d along = made.points[p] - made.points[best];
        if (east * along.x() + north * along.y() > 0) best = p;
      }
      return best;
    };
    origin = furthest(-1, -1);
    x_axis = furthest(1, -1);
    plane = furthest(0, 1);
    const Eigen::Vector3d x = (made.points[x_axis] - made.points[origin]).normalized();
    Eigen::Vector3d z = x.cross(made.points[plane] - made.points[origin]).normalized();
    if (z.z() < 0) z = -z;
    const Eigen::Vector3d y = z.cross(x);
    std::string text = "point,e_m,n_m,u_m\n";
    for (std::size_t p = 0; p < made.points.size(); ++p) {
      const Eigen::Vector3d d = made.points[p] - made.points[origin];
      char line[120];
      std::snprintf(line, sizeof line, "P%zu,%.9f,%.9f,%.9f\n", p, d.dot(x), d.dot(y), d.dot(z));
      text += line;
    }
    write_text(folder / "case/check.csv", text);
    write_text(folder / "case/frame.csv", "role,point\norigin," + name(origin) + "\nx_axis," +
                                              name(x_axis) + "\nplane," + name(plane) + "\n");
  }

  static std::string name(std::size_t p) { return "P" + std::to_string(p); }

  Json solved(std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), {"orient", "case"});
    outcome = run_plumbline(arguments, folder);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return summary_of(folder / "case/result");
  }

  std::map<std::string, std::string> point(std::size_t p) const {
    for (const auto& row : rows_of(folder / "case/result/points.csv"))
      if (row.at("point") == name(p)) return row;
    ADD_FAILURE() << name(p) << " was not measured";
    return {};
  }

  Outcome outcome;
  std::size_t origin = 0, x_axis = 0, plane = 0;
};

TEST_F(Frame, GivesResultsInTheFrameOfThreePointsWithTheirErrorBars) {
  double nees = 0, dof = 0;
  for (unsigned seed = 70; seed < 80; ++seed) {
    fs::remove_all(folder / "case");
    write_framed_case({.seed = seed});
    const Json summary = solved({});
    EXPECT_EQ(summary["check"]["same_frame"], true);
    EXPECT_EQ(summary["frame"]["x_axis"], name(x_axis));
    EXPECT_TRUE(summary["origin"].is_null());
    nees += summary["check"]["joint_nees"].get<double>();
    dof += summary["check"]["joint_nees_dof"].get<double>();
  }
  EXPECT_GT(dof, 600);  // ten times 75 coordinates less the six of the frame
  EXPECT_NEAR(nees / dof, 1, 3.3 * std::sqrt(2 / dof));
  for (const char* column : {"e_m", "n_m", "u_m", "sigma_e_m", "sigma_n_m", "sigma_u_m"})
    EXPECT_EQ(std::stod(point(origin).at(column)), 0) << column;
  for (const char* column : {"n_m", "u_m", "sigma_n_m", "sigma_u_m"})
    EXPECT_EQ(std::stod(point(x_axis).at(column)), 0) << column;
  EXPECT_GT(std::stod(point(x_axis).at("sigma_e_m")), 0);
  EXPECT_EQ(std::stod(point(plane).at("u_m")), 0);
  EXPECT_EQ(std::stod(point(plane).at("sigma_u_m")), 0);
}

TEST_F(Frame, IsAllTheDatumThatALengthAloneNeeds) {
  write_framed_case({.seed = 81, .stations = false, .length = true});
  const Json summary = solved({});
  EXPECT_THAT(summary["unobservable"].get<std::vector<std::string>>(), Not(Contains("position")));
  EXPECT_THAT(summary["unobservable"].get<std::vector<std::string>>(), Not(Contains("azimuth")));
  EXPECT_EQ(summary["check"]["same_frame"], true);
}

TEST_F(Frame, OfThreePointsOnALineIsRefused) {
  write_framed_case({.seed = 82});
  write_text(folder / "case/frame.csv", "role,point\norigin,P0\nx_axis,P1\nplane,P1\n");
  expect_refused({"orient", "case"}, "three different points");
  write_text(folder / "case/frame.csv", "role,point\norigin,P0\nx_axis,P1\nplane,P99\n");
  expect_refused({"orient", "case"}, "'P99'");
}

// A place on the earth is none in that frame.
TEST_F(Frame, ComparesNoPlacesOnTheEarth) {
  write_framed_case({.seed = 85});
  write_text(folder / "case/check.csv",
             "point,lat_deg,lon_deg,height_ellipsoidal_m\nP5,35.3,139.1,50\n");
  expect_refused({"orient", "case"}, "frame.csv");
}

TEST_F(Frame, PaperPrintsEveryStageAndItsPriors) {
  write_framed_case({.seed = 83, .stations = false, .side_step_m = 0, .length = true});
  const Json summary = solved({"--paper"});
  for (const char* words :
       {"(1) Heights", "(2) Relative orientation", "(3) Intersection", "(4) Scale", "(5) Resection",
        "(6) Final adjustment", "Standard accuracy (eq. 6)", "ground flat to 0.3 m", "flat answer"})
    EXPECT_THAT(outcome.out, HasSubstr(words));
  ASSERT_EQ(summary["stages"].size(), 6U);
  EXPECT_EQ(summary["stages"][0]["stage"], "heights");
  EXPECT_EQ(summary["stages"][0]["photos"].size(), 5U);
  EXPECT_NEAR(summary["stages"][0]["photos"][0]["height_m"].get<double>(), 70, 4);
  EXPECT_EQ(summary["stages"][5]["stage"], "final_adjustment");
  EXPECT_EQ(summary["converged"], true);
  EXPECT_TRUE(summary["check"]["flat_rmse_u_m"].is_number());
  EXPECT_TRUE(fs::exists(folder / "case/result/points.csv"));
}

// Nobody gave a control point: what holds the result is the definition of the frame.
TEST_F(Frame, PaperCallsThePointsOfItsFrameNoControlPoints) {
  write_framed_case({.seed = 83, .stations = false, .side_step_m = 0, .length = true});
  const Json summary = solved({"--paper"});
  const std::string warnings = lines_of(summary["warnings"]);
  EXPECT_THAT(warnings, Not(HasSubstr("control point")));
  EXPECT_THAT(warnings,
              HasSubstr("rests on point " + name(x_axis) + " (x axis of the local frame)"));
  EXPECT_THAT(text_of(folder / "case/result/report.html"), Not(HasSubstr("the control point")));
}

TEST_F(Frame, PaperWithoutLengthOrFrameIsRefusedInASentence) {
  write_framed_case({.seed = 84, .stations = false, .side_step_m = 0});
  expect_refused({"orient", "case", "--paper"}, "lengths.csv");
  fs::remove(folder / "case/frame.csv");
  expect_refused({"orient", "case", "--paper"}, "frame.csv");
}

}  // namespace
}  // namespace plumbline::acceptance
