// SPDX-License-Identifier: MIT
#include "firmware/ingest/camera_toml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::ingest {
namespace {

using geometry::Camera;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

// The example of the format's description, word for word.
constexpr const char* kExample = R"(name = "FC350"
width_px = 4000
height_px = 2250
focal_length_px = 2125.0            # principal distance in u pixels
principal_point_px = [1999.5, 1124.5]   # pixel centres are whole numbers
affinity = 0.0                      # fv = focal_length_px * (1 + affinity)
skew = 0.0
radial = [0.0, 0.0, 0.0]            # k1 k2 k3
tangential = [0.0, 0.0]             # p1 p2 as OpenCV
line_time_us = 0.0                  # rolling shutter, 0 = global
[sigma]                             # 0 = held fixed; missing = free
focal_length_px = 5.0
principal_point_px = [3.0, 3.0]
radial = [0.0, 0.0, 0.0]
)";

std::string sentence(const std::string& text) {
  const auto read = parse_camera_toml(text, "camera.toml");
  return read.ok() ? "" : read.error().sentence;
}

std::string with(const std::string& from, const std::string& to) {
  std::string text = kExample;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos);
  return text.replace(at, from.size(), to);
}

TEST(CameraToml, ReadsTheExample) {
  const auto read = parse_camera_toml(kExample, "camera.toml");
  ASSERT_TRUE(read.ok()) << read.error().sentence;
  EXPECT_TRUE(read->notices.empty());
  const Camera& camera = read->camera;
  EXPECT_EQ(camera.name, "FC350");
  EXPECT_EQ(camera.width_px, 4000);
  EXPECT_EQ(camera.height_px, 2250);
  EXPECT_EQ(camera.interior[geometry::kFocalLength], 2125);
  EXPECT_EQ(camera.interior[geometry::kPrincipalV], 1124.5);
  EXPECT_EQ(camera.sigma[geometry::kFocalLength], 5);
  EXPECT_EQ(camera.sigma[geometry::kPrincipalU], 3);
  EXPECT_EQ(camera.sigma[geometry::kRadial2], 0);
  EXPECT_EQ(camera.sigma[geometry::kAffinity], geometry::kFree);
  EXPECT_EQ(camera.sigma[geometry::kTangential1], geometry::kFree);
  EXPECT_FALSE(camera.covariance);
}

TEST(CameraToml, TakesWholeNumbersForDecimals) {
  const auto read =
      parse_camera_toml("width_px = 100\nheight_px = 80\nfocal_length_px = 90\n", "c");
  ASSERT_TRUE(read.ok());
  EXPECT_EQ(read->camera.interior[geometry::kFocalLength], 90);
  EXPECT_EQ(read->camera.interior[geometry::kPrincipalU], 49.5);
  EXPECT_EQ(read->camera.sigma[geometry::kRadial1], geometry::kFree);
}

TEST(CameraToml, SaysWhatIsWrongInOneSentenceWithTheLine) {
  EXPECT_THAT(sentence(with("5.0\n", "-5.0\n")), StartsWith("camera.toml:12: "));
  EXPECT_THAT(sentence(with("5.0\n", "nan\n")), HasSubstr("finite"));
  EXPECT_THAT(sentence(with("5.0\n", "inf\n")), HasSubstr("finite"));
  EXPECT_THAT(sentence(with("2125.0", "nan")), StartsWith("camera.toml:4: focal_length_px"));
  EXPECT_THAT(sentence(with("2125.0", "0.0")), HasSubstr("greater than 0"));
  EXPECT_THAT(sentence(with("2125.0", "\"long\"")), StartsWith("camera.toml:4: "));
  EXPECT_THAT(sentence(with("[1999.5, 1124.5]", "1999.5")), HasSubstr("list of 2"));
  EXPECT_THAT(sentence(with("[0.0, 0.0, 0.0]", "[0.0, 0.0]")), HasSubstr("list of 3"));
  EXPECT_THAT(sentence(with("width_px = 4000", "width_px = 1e300")), HasSubstr("width_px"));
  EXPECT_THAT(sentence(with("width_px = 4000", "width_px = 0")), StartsWith("camera.toml:2: "));
  EXPECT_THAT(sentence(with("width_px = 4000\n", "")), HasSubstr("width_px is missing"));
  EXPECT_THAT(sentence(with("skew = 0.0", "skew = ")), StartsWith("camera.toml:7: not valid TOML"));
  EXPECT_THAT(sentence(with("skew", "affinity")), HasSubstr("not valid TOML"));
}

TEST(CameraToml, NoticesKeysThatItDoesNotKnow) {
  const auto read = parse_camera_toml(with("skew = 0.0", "shew = 0.0"), "camera.toml");
  ASSERT_TRUE(read.ok());
  ASSERT_EQ(read->notices.size(), 1u);
  EXPECT_EQ(read->notices[0], "camera.toml:7: 'shew' is not known and was ignored.");
}

TEST(CameraToml, TakesACovarianceInsteadOfSigmas) {
  const std::string text = std::string(kExample) +
                           "affinity = 1e-4\n[covariance]\norder = [\"k1\", \"focal_length_px\"]\n"
                           "matrix = [[0.01, -0.27],\n [-0.27, 9.0]]\n";
  const auto read = parse_camera_toml(text, "camera.toml");
  ASSERT_TRUE(read.ok()) << read.error().sentence;
  ASSERT_TRUE(read->camera.covariance);
  const auto& covariance = *read->camera.covariance;
  EXPECT_EQ(covariance(geometry::kFocalLength, geometry::kFocalLength), 9);
  EXPECT_EQ(covariance(geometry::kFocalLength, geometry::kRadial1), -0.27);
  EXPECT_EQ(covariance(geometry::kRadial1, geometry::kFocalLength), -0.27);
  EXPECT_EQ(covariance(geometry::kPrincipalU, geometry::kPrincipalU), 9);  // its [sigma] stays
  EXPECT_EQ(covariance(geometry::kSkew, geometry::kSkew), 0);              // has none: held fixed
  ASSERT_EQ(read->notices.size(), 1u);
  EXPECT_THAT(read->notices[0], HasSubstr("names skew, tangential_1, tangential_2:"));
}

TEST(CameraToml, LeavesFreeBesideACovarianceWhatIsSaidToBe) {
  const auto read = parse_camera_toml(
      "width_px = 100\nheight_px = 80\nfocal_length_px = 90\n"
      "[sigma]\nskew = \"free\"\nradial = [0, \"free\", 0]\n"
      "[covariance]\norder = [\"focal_length_px\", \"affinity\"]\nmatrix = [[1, 0], [0, 1]]\n",
      "camera.toml");
  ASSERT_TRUE(read.ok()) << read.error().sentence;
  ASSERT_TRUE(read->camera.covariance);
  const auto& covariance = *read->camera.covariance;
  EXPECT_EQ(covariance(geometry::kSkew, geometry::kSkew), geometry::kFree);
  EXPECT_EQ(covariance(geometry::kRadial2, geometry::kRadial2), geometry::kFree);
  EXPECT_EQ(covariance(geometry::kRadial1, geometry::kRadial1), 0);
  EXPECT_EQ(read->camera.sigma[geometry::kSkew], geometry::kFree);
  ASSERT_EQ(read->notices.size(), 1u);
  EXPECT_THAT(read->notices[0], Not(HasSubstr("skew")));
}

TEST(CameraToml, RefusesAMatrixThatIsNoCovariance) {
  const auto covariance = [](const char* order, const char* matrix) {
    return sentence(std::string(kExample) + "[covariance]\norder = " + order +
                    "\nmatrix = " + matrix + "\n");
  };
  const char* const two = "[\"focal_length_px\", \"skew\"]";
  EXPECT_EQ(covariance(two, "[[1, 0.5], [0.5, 1]]"), "");
  EXPECT_THAT(covariance(two, "[[1, 0.5], [0.4, 1]]"), HasSubstr("not symmetric"));
  EXPECT_THAT(covariance(two, "[[1, 1.5], [1.5, 1]]"), HasSubstr("not positive"));
  EXPECT_THAT(covariance(two, "[[1, 2], [2, 4]]"), HasSubstr("not positive"));
  EXPECT_EQ(covariance(two, "[[1, 0.999999], [0.999999, 1]]"), "");
  EXPECT_THAT(covariance(two, "[[-1, 0], [0, 1]]"), HasSubstr("negative"));
  EXPECT_THAT(covariance(two, "[[1, 0]]"), HasSubstr("as many rows"));
  EXPECT_THAT(covariance(two, "[[1], [1]]"), HasSubstr("as many numbers"));
  EXPECT_THAT(covariance(two, "[[nan, 0], [0, 1]]"), HasSubstr("finite"));
  EXPECT_THAT(
      covariance("[\"focal_length_px\", \"zoom\"]", "[[1, 0], [0, 1]]"),
      AllOf(HasSubstr("'zoom'"), HasSubstr("principal_point_u_px"), HasSubstr("tangential_2")));
  EXPECT_THAT(covariance("[\"skew\", \"skew\"]", "[[1, 0], [0, 1]]"), HasSubstr("twice"));
}

TEST(CameraToml, TakesACovarianceThatHoldsNothingForNone) {
  const std::string camera =
      "width_px = 100\nheight_px = 80\nfocal_length_px = 90\n[sigma]\nfocal_length_px = 2\n";
  for (const char* const nothing : {"", "order = []\n", "order = []\nmatrix = []\n"}) {
    const auto read = parse_camera_toml(camera + "[covariance]\n" + nothing, "camera.toml");
    ASSERT_TRUE(read.ok()) << read.error().sentence;
    EXPECT_FALSE(read->camera.covariance);
    EXPECT_EQ(read->camera.sigma[geometry::kFocalLength], 2);
    EXPECT_EQ(read->camera.sigma[geometry::kSkew], geometry::kFree);
  }
  EXPECT_THAT(sentence(camera + "[covariance]\nmatrix = [[1]]\n"),
              AllOf(HasSubstr("'order'"), HasSubstr("focal_length_px, principal_point_u_px")));
}

TEST(CameraToml, WritesNoCovarianceWhereAllIsHeldFixed) {
  Camera camera;
  camera.width_px = 100;
  camera.height_px = 80;
  camera.interior[geometry::kFocalLength] = 90;
  camera.covariance = geometry::InteriorMatrix::Zero();
  EXPECT_THAT(camera_toml(camera), Not(HasSubstr("[covariance]")));
  const auto read = parse_camera_toml(camera_toml(camera), "camera.toml");
  ASSERT_TRUE(read.ok()) << read.error().sentence;
  EXPECT_EQ(read->camera.sigma, geometry::InteriorVector(geometry::InteriorVector::Zero()));
}

Camera random_camera(std::mt19937_64& random, bool with_covariance) {
  std::uniform_real_distribution<double> some(-1, 1);
  Camera camera;
  camera.name = "a \"quoted\" \\ name";
  camera.width_px = 4000;
  camera.height_px = 3000;
  for (int i = 0; i < geometry::kInteriorCount; ++i) camera.interior[i] = some(random) / 3;
  camera.interior[geometry::kFocalLength] = 3000 + some(random);
  for (double& sigma : camera.sigma) {
    const double kind = some(random);
    sigma = kind < -0.5 ? geometry::kFree : kind < 0 ? 0 : std::abs(some(random)) * 1e-3;
  }
  camera.line_time_us = 28.5 + some(random);
  if (with_covariance) {
    geometry::InteriorMatrix root = geometry::InteriorMatrix::NullaryExpr(
        [&](Eigen::Index, Eigen::Index) { return some(random); });
    root.row(geometry::kRadial3).setZero();
    const geometry::InteriorMatrix product = root * root.transpose();
    camera.covariance = product.selfadjointView<Eigen::Lower>();
    camera.sigma = camera.covariance->diagonal().cwiseSqrt();
  }
  return camera;
}

TEST(CameraToml, WritesEveryNumberSoThatItReadsBackAsTheSame) {
  std::mt19937_64 random(1);
  for (int trial = 0; trial < 200; ++trial) {
    const Camera camera = random_camera(random, trial % 2 == 1);
    const std::string text = camera_toml(camera);
    const auto read = parse_camera_toml(text, "camera.toml");
    ASSERT_TRUE(read.ok()) << read.error().sentence << "\n" << text;
    EXPECT_TRUE(read->notices.empty());
    EXPECT_EQ(read->camera.name, camera.name);
    EXPECT_EQ(read->camera.interior, camera.interior);
    EXPECT_EQ(read->camera.sigma, camera.sigma);
    EXPECT_EQ(read->camera.line_time_us, camera.line_time_us);
    ASSERT_EQ(read->camera.covariance.has_value(), camera.covariance.has_value());
    if (camera.covariance) {
      EXPECT_EQ(*read->camera.covariance, *camera.covariance);
    }
    EXPECT_EQ(camera_toml(read->camera), text);
  }
}

TEST(CameraToml, SurvivesAnyDamage) {
  std::mt19937_64 random(2);
  const std::string whole = camera_toml(random_camera(random, true));
  for (int trial = 0; trial < 3000; ++trial) {
    std::string text = whole;
    for (auto flips = 1 + random() % 5; flips > 0; --flips) {
      text[random() % text.size()] = static_cast<char>(random() % 256);
    }
    const auto read = parse_camera_toml(text, "camera.toml");
    if (read.ok()) {
      EXPECT_TRUE(read->camera.interior.allFinite());
    }
  }
}

TEST(CameraToml, SaysThatAFileIsMissing) {
  const TemporaryFolder folder;
  const auto read = read_camera_toml(folder / "camera.toml");
  ASSERT_FALSE(read.ok());
  EXPECT_THAT(read.error().sentence, HasSubstr("camera.toml"));
}

}  // namespace
}  // namespace plumbline::ingest
