// SPDX-License-Identifier: MIT
// From photos of a small simulated climb to points with error bars, and what is said about them.
#include <gmock/gmock.h>

#include <cmath>
#include <cstdlib>

#include "edge/jpeg/jpeg.h"
#include "tests/firmware/commands/acceptance/flight_folder.h"

namespace plumbline::acceptance {
namespace {

using testing::AllOf;
using testing::Contains;
using testing::HasSubstr;
using testing::Not;

std::vector<std::string> texts(const Json& list) { return list.get<std::vector<std::string>>(); }

double number(const std::string& cell) { return std::strtod(cell.c_str(), nullptr); }

class Flight : public FlightTest {};

TEST_F(Flight, WithASideStepIsAsAccurateAsStatedAndKnowsItsAzimuth) {
  copy_photos();
  const Outcome outcome = measure({"--picks", picks.string(), "--check", check.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  const Json result = summary();
  EXPECT_EQ(result["photos_used"], 6);
  EXPECT_THAT(texts(result["unobservable"]), Not(Contains("azimuth")));
  for (const std::string axis : {"_e_m", "_n_m", "_u_m"}) {
    EXPECT_LE(result["check"]["rmse" + axis].get<double>(),
              2 * result["check"]["rms_stated_sigma" + axis].get<double>())
        << axis;
  }
  EXPECT_EQ(rows_of(folder / "result/check.csv").size(), 16U);
}

TEST_F(Flight, StraightUpWithoutHeadingNamesTheAzimuthAndKeepsItsShape) {
  copy_photos(5);
  std::string of_five;
  for (auto& row : rows_of(picks)) {
    if (row["photo"] == "0006.jpg") continue;
    of_five += row["photo"] + "," + row["point"] + "," + row["u_px"] + "," + row["v_px"] + ",0.1\n";
  }
  write_text(folder / "picks.csv", "photo,point,u_px,v_px,sigma_px\n" + of_five);
  const Outcome outcome = measure({"--picks", "picks.csv", "--check", check.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json result = summary();
  EXPECT_EQ(result["photos_used"], 5);
  EXPECT_THAT(texts(result["unobservable"]), Contains("azimuth"));
  EXPECT_GT(result["check"]["rms_stated_sigma_e_m"].get<double>(), 0.5);
  EXPECT_LT(result["check"]["best_fit_rmse_e_m"].get<double>(), 0.1);
  EXPECT_LT(result["check"]["best_fit_rmse_n_m"].get<double>(), 0.1);
}

TEST_F(Flight, WithPicksOfAPhotoThatIsNotThereIsRefused) {
  copy_photos(5);
  expect_measure_refused({"--picks", picks.string()}, "there is no photo '0006.jpg'");
}

// Points are often picked after a flight was measured: what was found then need not be found again.
TEST_F(Flight, IsMeasuredAgainFromTheTiesOfAnEarlierResult) {
  copy_photos();
  const std::vector<std::string> options{"--picks", picks.string(), "--check", check.string()};
  ASSERT_EQ(measure(options).status, 0);
  const Json anew = summary();
  fs::remove_all(folder / "result");
  ASSERT_EQ(measure({}).status, 0);
  fs::rename(folder / "result", folder / "earlier");
  auto from_earlier = options;
  from_earlier.insert(from_earlier.end(), {"--ties-from", "earlier"});
  const Outcome outcome = measure(from_earlier);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json again = summary();
  EXPECT_EQ(again["tie_points"], anew["tie_points"]);
  // Pixels are written to 0.0001.
  for (const std::string axis : {"_e_m", "_n_m", "_u_m"}) {
    EXPECT_NEAR(again["check"]["rmse" + axis].get<double>(),
                anew["check"]["rmse" + axis].get<double>(), 1e-3)
        << axis;
  }
}

TEST_F(Flight, WithTiesOfOtherPhotosIsRefused) {
  copy_photos();
  fs::create_directory(folder / "other");
  write_text(folder / "other/observations.csv",
             "photo,point,u_px,v_px,sigma_px\n0009.jpg,T1,1,2,0.1\n");
  expect_measure_refused({"--ties-from", "other"}, "there is no photo '0009.jpg'");
}

TEST_F(Flight, IsMeasuredToTheSameBytesTwiceAndWithOneThread) {
  copy_photos();
  const std::vector<std::string> options{"--picks", picks.string(), "--check", check.string()};
  std::vector<std::map<std::string, std::string>> results;
  for (const std::string threads : {"2", "2", "1"}) {
    auto more = options;
    more.insert(more.end(), {"--threads", threads});
    ASSERT_EQ(measure(more).status, 0);
    results.push_back(files_of(folder / "result"));
    EXPECT_EQ(results.back().erase("timing.json"), 1U);
    fs::remove_all(folder / "result");
  }
  EXPECT_EQ(results[0].size(), 7U);
  EXPECT_TRUE(results[0] == results[1]) << "a second run differs";
  EXPECT_TRUE(results[0] == results[2]) << "a run with one thread differs";
}

TEST_F(Flight, IsReportedAsJsonWithEveryAgreedKey) {
  copy_photos();
  const Outcome outcome = measure({"--picks", picks.string(), "--check", check.string(), "--json"});
  ASSERT_EQ(outcome.status, 0);
  const Json printed = Json::parse(outcome.out, nullptr, false);
  EXPECT_EQ(printed, summary());
  for (const char* key :
       {"converged", "iterations", "sigma0", "sigma0_by_group", "image_sigma_px", "redundancy",
        "photos_given", "photos_used", "tie_points", "tie_points_3plus", "reprojection_rms_px",
        "observations_rejected", "unobservable", "warnings", "origin", "datum", "version",
        "input_sha256", "check"}) {
    EXPECT_TRUE(printed.contains(key)) << key;
  }
  for (const char* key : {"lat_deg", "lon_deg", "height_ellipsoidal_m"}) {
    EXPECT_TRUE(printed["origin"].contains(key)) << key;
  }
  EXPECT_EQ(printed["converged"], true);
  EXPECT_EQ(printed["datum"], "that of the base");
  for (const char* file : {"0001.jpg", "camera.toml", "picks.csv", "check.csv"}) {
    EXPECT_EQ(printed["input_sha256"][file].get<std::string>().size(), 64U) << file;
  }
}

TEST_F(Flight, OfPhotosThatDifferInSizeIsRefused) {
  copy_photos(5);
  Image other;
  other.width_px = 64;
  other.height_px = 48;
  other.channels = 1;
  other.data.assign(64 * 48, 128);
  const auto bytes = jpeg::encode(other, 90);
  write_text(photos / "0006.jpg", std::string(bytes.begin(), bytes.end()));
  expect_measure_refused({}, "The photos differ in size: '0006.jpg' has 64 x 48 pixels");
}

class FlightWithoutPositions : public FlightTest {
 protected:
  void SetUp() override {
    FlightTest::SetUp();
    copy_photos_without_tags();
  }

  double distance_m(const fs::path& csv, const std::string& a, const std::string& b) {
    std::map<std::string, std::map<std::string, std::string>> points;
    for (auto& row : rows_of(csv)) points[row["point"]] = row;
    double square = 0;
    for (const char* axis : {"e_m", "n_m", "u_m"}) {
      square += std::pow(number(points[a][axis]) - number(points[b][axis]), 2);
    }
    return std::sqrt(square);
  }
};

TEST_F(FlightWithoutPositions, IsMeasuredUpToPositionAndScale) {
  ASSERT_EQ(measure({}).status, 0);
  EXPECT_EQ(summary()["photos_used"], 6);
  EXPECT_THAT(texts(summary()["unobservable"]), AllOf(Contains("scale"), Contains("position")));
  EXPECT_TRUE(summary()["origin"].is_null());
}

TEST_F(FlightWithoutPositions, GetsItsScaleFromOneKnownLength) {
  const double known = distance_m(check, "P03", "P12");
  const Outcome outcome = measure({"--picks", picks.string(), "--check", check.string(), "--length",
                                   "P03,P12," + digits(known) + ",0.005"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto unobservable = texts(summary()["unobservable"]);
  EXPECT_THAT(unobservable, Not(Contains("scale")));
  EXPECT_THAT(unobservable, AllOf(Contains("position"), Contains("azimuth")));
  const double truth = distance_m(check, "P13", "P07");
  const double measured = distance_m(folder / "result/points.csv", "P13", "P07");
  const double sigma =
      truth * std::hypot(summary()["common_sigmas"]["scale"].get<double>(), 0.1 / 200);
  EXPECT_NEAR(measured, truth, 4 * sigma);
}

class FlightWithSingleFixes : public FlightTest {};

// Of the tags of a drone without corrections: another flag, and no sigmas.
std::string without_corrections(std::string jpeg) {
  const auto replace = [&](const std::string& from, const std::string& to) {
    const auto at = jpeg.find(from);
    ASSERT_NE(at, std::string::npos) << from;
    jpeg.replace(at, from.size(), to);
  };
  replace("RtkFlag=\"50\"", "RtkFlag=\"16\"");
  for (const std::string axis : {"Lon", "Lat", "Hgt"}) replace("RtkStd" + axis, "NotStd" + axis);
  return jpeg;
}

TEST_F(FlightWithSingleFixes, IsToldWhichFiguresAreRelativeOnly) {
  copy_photos();
  for (const auto& entry : fs::directory_iterator(photos)) {
    write_text(entry.path(), without_corrections(text_of(entry.path())));
  }
  const Outcome outcome = measure({"--picks", picks.string()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const Json result = summary();
  EXPECT_THAT(texts(result["unobservable"]),
              testing::AnyOf(Contains("position"), Contains("gnss_offset")));
  EXPECT_THAT(lines_of(result["relative_only"]), HasSubstr("Position of the whole"));
  EXPECT_THAT(lines_of(result["warnings"]), HasSubstr("single fixes"));
  EXPECT_GT(result["common_sigmas"]["position_m"].get<double>(), 1.0);
}

class PhotosThatDoNotFit : public FlightTest {
 protected:
  // Soft random blobs: texture in plenty, but of no place on earth.
  static std::string other_ground(unsigned seed) {
    Image image;
    image.width_px = 720;
    image.height_px = 405;
    image.channels = 1;
    image.data.resize(720 * 405);
    std::vector<int> cells(100 * 60);
    for (int& cell : cells) {
      seed = seed * 1664525U + 1013904223U;
      cell = static_cast<int>(seed >> 24U);
    }
    for (std::size_t v = 0; v < 405; ++v) {
      for (std::size_t u = 0; u < 720; ++u) {
        image.data[v * 720 + u] = static_cast<std::uint8_t>(blend(cells, u, v));
      }
    }
    const auto bytes = jpeg::encode(image, 93);
    return {bytes.begin(), bytes.end()};
  }

  static int blend(const std::vector<int>& cells, std::size_t u, std::size_t v) {
    const std::size_t at = v / 8 * 100 + u / 8;
    const int a = static_cast<int>(u % 8), b = static_cast<int>(v % 8);
    return (cells[at] * (8 - a) * (8 - b) + cells[at + 1] * a * (8 - b) +
            cells[at + 100] * (8 - a) * b + cells[at + 101] * a * b) /
           64;
  }

  void add_same_place_as_first(const std::string& name) {
    const std::string bytes = text_of(shared_flight() / "photos/0001.jpg");
    const std::vector<std::uint8_t> first(bytes.begin(), bytes.end());
    auto image = jpeg::decode_grey(first, name);
    ASSERT_TRUE(image);
    unsigned seed = 17;
    for (auto& pixel : image->data) {
      seed = seed * 1664525U + 1013904223U;
      const int noisy = pixel + static_cast<int>(seed >> 24U) % 7 - 3;
      pixel = static_cast<std::uint8_t>(std::min(255, std::max(0, noisy)));
    }
    const auto again = jpeg::encode(*image, 93);
    write_text(photos / name, std::string(again.begin(), again.end()));
  }
};

TEST_F(PhotosThatDoNotFit, AreRefusedWhereNoneOverlaps) {
  write_text(photos / "a.jpg", other_ground(1));
  write_text(photos / "b.jpg", other_ground(2));
  write_text(photos / "c.jpg", other_ground(3));
  expect_measure_refused({}, "do not overlap");
}

TEST_F(PhotosThatDoNotFit, AreLeftOutAndSaidAmongOthersThatDo) {
  copy_photos();
  write_text(photos / "other.jpg", other_ground(4));
  ASSERT_EQ(measure({}).status, 0);
  EXPECT_EQ(summary()["photos_given"], 7);
  EXPECT_EQ(summary()["photos_used"], 6);
  EXPECT_THAT(lines_of(summary()["warnings"]), HasSubstr("other.jpg"));
}

TEST_F(PhotosThatDoNotFit, AreRefusedWhereBothWereTakenInOnePlace) {
  copy_photos(1);
  add_same_place_as_first("again.jpg");
  expect_measure_refused({}, "same place");
}

TEST_F(PhotosThatDoNotFit, MayBeTwoOfOnePlaceAmongOthers) {
  copy_photos();
  add_same_place_as_first("again.jpg");
  ASSERT_EQ(measure({}).status, 0);
  EXPECT_EQ(summary()["photos_used"], 7);
  EXPECT_EQ(summary()["converged"], true);
}

}  // namespace
}  // namespace plumbline::acceptance
