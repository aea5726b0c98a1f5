// SPDX-License-Identifier: MIT
#include "firmware/deliver/deliver.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "firmware/deliver/csv_files.h"
#include "firmware/deliver/table.h"
#include "firmware/ingest/camera_toml.h"
#include "firmware/ingest/csv_table.h"
#include "tests/firmware/deliver/files_of.h"
#include "tests/firmware/deliver/sample_product.h"

namespace plumbline::deliver {
namespace {

using nlohmann::json;
using testing::ElementsAre;
using testing::HasSubstr;
using testing::Key;
using testing::Not;

// Rows of a written table by their first cell; cells by column.
using Rows = std::vector<std::map<std::string, std::string>>;
Rows parsed(const std::string& text) {
  const ingest::CsvTable table = ingest::parse_csv(text, "table").value();
  Rows rows;
  for (const ingest::CsvRow& row : table.rows) {
    rows.emplace_back();
    for (std::size_t i = 0; i < table.columns.size(); ++i)
      rows.back()[table.columns[i]] = row.cells[i];
  }
  return rows;
}

std::string header_of(const std::string& text) { return text.substr(0, text.find('\n')); }

TEST(Deliver, WritesTheFilesThatOthersRelyOn) {
  const ScratchFolder scratch;
  ASSERT_TRUE(write(sample_product(), {{{"ties", 1.5}}, 1 << 20}, scratch.path() / "r").ok());
  EXPECT_THAT(
      files_of(scratch.path() / "r"),
      ElementsAre(Key("camera.toml"), Key("check.csv"), Key("observations.csv"), Key("photos.csv"),
                  Key("points.csv"), Key("report.html"), Key("summary.json"), Key("timing.json")));
}

TEST(Deliver, ASecondRunWithoutCheckPointsTakesTheOldCheckAway) {
  const ScratchFolder scratch;
  ASSERT_TRUE(write(sample_product(), {}, scratch.path()).ok());
  SampleOptions options;
  options.check = false;
  ASSERT_TRUE(write(sample_product(options), {}, scratch.path()).ok());
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "check.csv"));
  EXPECT_TRUE(std::filesystem::exists(scratch.path() / "points.csv"));
}

TEST(Deliver, TheSameProductGivesTheSameBytesApartFromTheTimes) {
  const ScratchFolder scratch;
  ASSERT_TRUE(write(sample_product(), {{{"ties", 1.5}}, 1}, scratch.path() / "1").ok());
  ASSERT_TRUE(write(sample_product(), {{{"ties", 9.5}}, 2}, scratch.path() / "2").ok());
  auto first = files_of(scratch.path() / "1");
  auto second = files_of(scratch.path() / "2");
  EXPECT_NE(first["timing.json"], second["timing.json"]);
  first.erase("timing.json");
  second.erase("timing.json");
  EXPECT_EQ(first, second);
}

TEST(Deliver, AnOriginThatIsNoPlaceIsAnErrorAndWritesNothing) {
  const ScratchFolder scratch;
  Product product = sample_product();
  product.origin->latitude_deg = 136.0;
  EXPECT_FALSE(write(product, {}, scratch.path() / "r").ok());
  EXPECT_FALSE(std::filesystem::exists(scratch.path() / "r"));
}

TEST(PointsCsv, HasTheAgreedColumnsAndReadsBackToAMicrometre) {
  const Product product = sample_product();
  const std::string text = points_csv(product).value();
  EXPECT_EQ(header_of(text),
            "point,e_m,n_m,u_m,sigma_e_m,sigma_n_m,sigma_u_m,cov_en_m2,cov_eu_m2,cov_nu_m2,rays,"
            "residual_rms_px,lat_deg,lon_deg,height_ellipsoidal_m,zone,x_north_m,y_east_m");
  const Rows rows = parsed(text);
  ASSERT_EQ(rows.size(), product.solution.points.size());
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const orient::MeasuredPoint& point = product.solution.points[i];
    EXPECT_EQ(rows[i].at("point"), product.problem.point_names[i]);
    EXPECT_NEAR(std::stod(rows[i].at("n_m")), point.in_enu_m.y(), 1e-6);
    EXPECT_NEAR(std::stod(rows[i].at("sigma_u_m")), std::sqrt(point.covariance_m2(2, 2)), 1e-6);
    EXPECT_NEAR(std::stod(rows[i].at("cov_eu_m2")), point.covariance_m2(0, 2), 1e-12);
    EXPECT_EQ(std::stoi(rows[i].at("rays")), point.rays);
    EXPECT_EQ(rows[i].at("zone"), "IX");
  }
}

// Radii of curvature of GRS80 at the latitude of the origin, by hand: M 6358.0 km, N 6385.5 km.
TEST(PointsCsv, PlacesOnTheEarthDifferAsTheGroundDoes) {
  const Rows rows = parsed(points_csv(sample_product()).value());
  const auto step = [&](const char* column) {
    return std::stod(rows[17].at(column)) - std::stod(rows[3].at(column));
  };
  constexpr double kRad = 3.14159265358979 / 180;
  const double latitude_rad = 36.1037 * kRad;
  EXPECT_NEAR(step("lat_deg") * kRad * 6358.0e3, step("n_m"), 0.01);
  EXPECT_NEAR(step("lon_deg") * kRad * 6385.5e3 * std::cos(latitude_rad), step("e_m"), 0.01);
  EXPECT_NEAR(step("height_ellipsoidal_m"), step("u_m"), 0.001);
  EXPECT_NEAR(std::hypot(step("x_north_m"), step("y_east_m")),
              0.9999 * std::hypot(step("n_m"), step("e_m")), 0.01);
}

TEST(PointsCsv, WithoutAnOriginThereAreNoColumnsOfTheEarth) {
  SampleOptions options;
  options.georeferenced = false;
  EXPECT_THAT(header_of(points_csv(sample_product(options)).value()), Not(HasSubstr("lat_deg")));
}

TEST(PointsCsv, OutsideJapanTheGridIsUtm) {
  Product product = sample_product();
  product.origin = GeoOrigin{47.37, 8.54, 450};
  EXPECT_EQ(parsed(points_csv(product).value())[0].at("zone"), "32N");
}

// UTM ends at 84 degrees north and 80 south; latitude, longitude and height do not.
TEST(PointsCsv, NearAPoleTheGridIsBlank) {
  Product product = sample_product();
  for (const double latitude_deg : {90.0, -89.9999, -80.5}) {
    product.origin = GeoOrigin{latitude_deg, 8.54, 2835};
    const auto text = points_csv(product);
    ASSERT_TRUE(text.ok()) << text.error().sentence;
    const auto row = parsed(*text)[0];
    for (const char* column : {"zone", "x_north_m", "y_east_m"}) EXPECT_EQ(row.at(column), "");
    EXPECT_NEAR(std::stod(row.at("lat_deg")), latitude_deg, 0.01);
    EXPECT_NEAR(std::stod(row.at("height_ellipsoidal_m")), 2835, 100);
  }
}

TEST(PointsCsv, NamesWithCommasQuotesAndHashesReadBack) {
  Product product = sample_product();
  product.problem.point_names[0] = "a, \"b\"";
  product.problem.point_names[1] = "#7";
  product.problem.point_names[2] = "\xe5\x9f\xba\xe6\xba\x96";
  const Rows rows = parsed(points_csv(product).value());
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_EQ(rows[i].at("point"), product.problem.point_names[i]);
}

TEST(PhotosCsv, HasAllPhotosWithBlanksForThoseNotOriented) {
  SampleOptions options;
  options.one_unoriented = true;
  const Product product = sample_product(options);
  const std::string text = photos_csv(product);
  EXPECT_EQ(header_of(text),
            "photo,e_m,n_m,u_m,omega_deg,phi_deg,kappa_deg,sigma_e_m,sigma_n_m,sigma_u_m,"
            "sigma_omega_deg,sigma_phi_deg,sigma_kappa_deg,gnss_residual_e_m,gnss_residual_n_m,"
            "gnss_residual_u_m,gnss_redundancy_e,gnss_redundancy_n,gnss_redundancy_u,"
            "gnss_detectable_e_m,gnss_detectable_n_m,gnss_detectable_u_m,gnss_directions,"
            "gnss_statistic,gnss_critical,gnss_used");
  const Rows rows = parsed(text);
  ASSERT_EQ(rows.size(), 6u);
  EXPECT_NEAR(std::stod(rows[1].at("u_m")), 75.0, 1e-6);
  EXPECT_NEAR(std::stod(rows[1].at("sigma_u_m")), std::sqrt(6e-5), 1e-6);
  EXPECT_NEAR(std::stod(rows[0].at("kappa_deg")), 17.0, 10.0);
  EXPECT_EQ(rows[5].at("photo"), "DJI_0006.JPG");
  EXPECT_EQ(rows[5].at("e_m"), "");
}

TEST(ObservationsCsv, ListsEveryObservationWithItsResidual) {
  const Product product = sample_product();
  const std::string text = observations_csv(product);
  EXPECT_EQ(header_of(text),
            "photo,point,u_px,v_px,sigma_px,residual_u_px,residual_v_px,used,redundancy_u,"
            "redundancy_v,w_u,w_v");
  const Rows rows = parsed(text);
  ASSERT_EQ(rows.size(), product.problem.observations.size());
  int unused = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    EXPECT_NEAR(std::stod(rows[i].at("u_px")), product.problem.observations[i].pixel.x(), 1e-4);
    EXPECT_NEAR(std::stod(rows[i].at("residual_v_px")),
                product.solution.residuals[i].residual_px.y(), 1e-4);
    unused += rows[i].at("used") == "0";
  }
  EXPECT_EQ(unused, product.solution.summary.observations_rejected);
}

TEST(ObservationsCsv, TheResidualAtAPointNotMeasuredIsBlank) {
  Product product = sample_product();
  product.solution.points[0] = orient::MeasuredPoint{};
  const Rows rows = parsed(observations_csv(product));
  EXPECT_EQ(rows[0].at("residual_u_px"), "");
  EXPECT_NE(rows[0].at("u_px"), "");
}

TEST(CheckCsv, DifferencesAndSigmasReadBack) {
  const Product product = sample_product();
  const Rows rows = parsed(check_csv(*product.check));
  ASSERT_EQ(rows.size(), 13u);
  EXPECT_NEAR(std::stod(rows[4].at("difference_u_m")), product.check->points[4].difference_m.z(),
              1e-6);
  EXPECT_NEAR(std::stod(rows[4].at("sigma_e_m")), product.check->points[4].sigma_m.x(), 1e-6);
}

TEST(SummaryJson, HasEveryKeyThatOthersRelyOn) {
  const json summary = json::parse(summary_json(sample_product()));
  for (const char* key : {"converged",
                          "iterations",
                          "sigma0",
                          "sigma0_by_group",
                          "image_sigma_px",
                          "redundancy",
                          "photos_given",
                          "photos_used",
                          "tie_points",
                          "tie_points_3plus",
                          "reprojection_rms_px",
                          "observations_rejected",
                          "unobservable",
                          "unobservable_explained",
                          "warnings",
                          "origin",
                          "datum",
                          "version",
                          "input_sha256",
                          "check",
                          "options"})
    EXPECT_TRUE(summary.contains(key)) << key;
  EXPECT_EQ(summary["origin"]["lat_deg"], 36.1037);
  EXPECT_EQ(summary["photos_used"], 6);
  EXPECT_EQ(summary["sigma0_by_group"]["gnss"], 0.94);
  EXPECT_EQ(summary["options"]["max_azimuth_sigma_deg"], 5.0);
  EXPECT_EQ(summary["input_sha256"].size(), 2u);
}

TEST(SummaryJson, NamesWhatIsNotObservableAndExplainsIt) {
  SampleOptions options;
  options.side_step = false;
  const json summary = json::parse(summary_json(sample_product(options)));
  EXPECT_EQ(summary["unobservable"], json::array({"azimuth"}));
  EXPECT_THAT(summary["unobservable_explained"]["azimuth"].get<std::string>(),
              HasSubstr("Fly 10 m aside"));
}

TEST(SummaryJson, SaysWhichFiguresAreRelativeOnlyWithPoorPositions) {
  SampleOptions options;
  options.poor_gnss = true;
  const std::string relative =
      json::parse(summary_json(sample_product(options)))["relative_only"].dump();
  EXPECT_THAT(relative, HasSubstr("Position"));
  EXPECT_THAT(relative, HasSubstr("Scale"));
  EXPECT_THAT(json::parse(summary_json(sample_product()))["relative_only"], testing::IsEmpty());
}

TEST(SummaryJson, TheCheckHasRmseSharesAndTheJointTest) {
  const Product product = sample_product();
  const json check = json::parse(summary_json(product))["check"];
  EXPECT_NEAR(check["rmse_u_m"], product.check->rmse_m.z(), 1e-8);
  EXPECT_NEAR(check["largest_m"], product.check->largest_m, 1e-8);
  EXPECT_NEAR(check["share_within_one_sigma"], product.check->share_within_one_sigma, 1e-7);
  EXPECT_EQ(check["joint_nees_dof"], 39);
  EXPECT_GT(check["best_fit_rmse_e_m"], 0.0);
}

// What a free network leaves open arrives as infinity or NaN.
Product with_unknowns() {
  Product product = sample_product();
  const double unknown = std::numeric_limits<double>::quiet_NaN();
  const double infinite = std::numeric_limits<double>::infinity();
  product.solution.summary.sigma0 = unknown;
  product.solution.summary.common = {infinite, unknown, infinite, infinite, infinite, unknown};
  product.solution.points[0].covariance_m2.setConstant(infinite);
  product.solution.points[1].covariance_m2.setConstant(unknown);
  product.solution.points[2].local_covariance_m2.setConstant(unknown);
  product.solution.points[3].residual_rms_px = unknown;
  product.solution.photos[0].covariance.setConstant(infinite);
  product.solution.photos[1].sigma_omega_phi_kappa_rad.setConstant(unknown);
  product.solution.residuals[0].residual_px.setConstant(unknown);
  product.solution.camera.covariance.reset();
  product.check->points[0].sigma_m.setConstant(unknown);
  product.check->rms_stated_sigma_m.setConstant(infinite);
  return product;
}

TEST(Deliver, NothingUnknownIsEverWrittenAsANumber) {
  const ScratchFolder scratch;
  ASSERT_TRUE(write(with_unknowns(), {}, scratch.path()).ok());
  const auto files = files_of(scratch.path());
  for (const char* name :
       {"points.csv", "photos.csv", "observations.csv", "check.csv", "summary.json"}) {
    EXPECT_THAT(files.at(name), Not(testing::ContainsRegex("[,: ]-?(nan|inf|NaN|Inf)"))) << name;
  }
  EXPECT_THAT(files.at("report.html"), Not(testing::ContainsRegex("[^a-z](nan|inf)[^a-z]")));
  EXPECT_TRUE(json::parse(files.at("summary.json"))["sigma0"].is_null());
  EXPECT_EQ(parsed(files.at("points.csv"))[0].at("sigma_e_m"), "");
  EXPECT_THAT(accuracy_table(with_unknowns()), Not(testing::ContainsRegex(" -?(nan|inf)[ \n]")));
}

TEST(Deliver, TheCameraReadsBackAsItWasAdjusted) {
  const ScratchFolder scratch;
  const Product product = sample_product();
  ASSERT_TRUE(write(product, {}, scratch.path()).ok());
  const auto camera = ingest::read_camera_toml(scratch.path() / "camera.toml").value().camera;
  EXPECT_EQ(camera.interior, product.solution.camera.interior);
  ASSERT_TRUE(camera.covariance);
  EXPECT_TRUE(camera.covariance->isApprox(*product.solution.camera.covariance, 1e-15));
}

TEST(AccuracyTable, SaysWhatWasMeasuredHowWellAndWhatIsMissing) {
  SampleOptions options;
  options.side_step = false;
  const std::string table = accuracy_table(sample_product(options));
  for (const char* words : {"5 of 5", "39 named points, median sigma", "13 check points, RMSE",
                            "Not observable", "Fly 10 m aside", "No joint test"})
    EXPECT_THAT(table, HasSubstr(words));
}

}  // namespace
}  // namespace plumbline::deliver
