// SPDX-License-Identifier: MIT
// Where a case gives no result, or a doubtful one, the cause is named.
#include <gmock/gmock.h>

#include <functional>
#include <sstream>

#include "tests/firmware/commands/acceptance/flight_folder.h"
#include "tests/firmware/commands/acceptance/made_case.h"

namespace plumbline::acceptance {
namespace {

using testing::HasSubstr;

using Cells = std::vector<std::string>;

class Cause : public FolderTest {
 protected:
  void SetUp() override {
    FolderTest::SetUp();
    write_case({.seed = 95}, folder / "case");
  }

  // Every row below the header, as `change` makes it.
  void change_rows(const std::string& file, const std::function<void(Cells&)>& change) {
    std::istringstream lines(text_of(folder / "case" / file));
    std::string text, line;
    std::getline(lines, line);
    for (text = line + "\n"; std::getline(lines, line);) {
      std::istringstream row(line);
      Cells cells;
      for (std::string cell; std::getline(row, cell, ',');) cells.push_back(cell);
      change(cells);
      for (std::size_t i = 0; i < cells.size(); ++i) text += (i == 0 ? "" : ",") + cells[i];
      text += "\n";
    }
    write_text(folder / "case" / file, text);
  }

  void replace_in_camera(const std::string& from, const std::string& to) {
    std::string text = text_of(folder / "case/camera.toml");
    const std::size_t at = text.find(from);
    ASSERT_NE(at, std::string::npos);
    write_text(folder / "case/camera.toml", text.replace(at, text.find('\n', at) - at, to));
  }

  std::string warnings() {
    const Outcome outcome = run_plumbline({"orient", "case"}, folder);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return lines_of(summary_of(folder / "case/result")["warnings"]);
  }
};

TEST_F(Cause, IsMeasurementsThatContradictEachOther) {
  for (const int of_ten : {8, 10}) {
    int row = 0, count = 0;
    change_rows("observations.csv", [&](Cells& cells) {
      row = (row * 7919 + 4241) % 100'003;
      if (count++ % 10 >= of_ten) return;
      cells[2] = std::to_string(row % 4000);
      cells[3] = std::to_string(row * 31 % 2250);
    });
    expect_refused({"orient", "case"}, "agree with each other");
  }
}

// A climb with one side-step: a focal length that is far off stretches the plan, and only the photo
// aside tells.
TEST_F(Cause, IsAFocalLengthThatOnlyOneStationTells) {
  for (const char* f : {"4250", "20000", "1e5"}) {
    SCOPED_TRACE(f);
    replace_in_camera("focal_length_px", std::string("focal_length_px = ") + f);
    EXPECT_THAT(warnings(), HasSubstr("the position may be right"));
  }
}

TEST_F(Cause, IsASigmaOfPixelsThatIsTooSmall) {
  change_rows("observations.csv", [](Cells& cells) { cells[4] = "1e-6"; });
  expect_refused({"orient", "case"}, "whether a sigma is too small");
}

TEST_F(Cause, IsASigmaOfPixelsThatIsTooLarge) {
  change_rows("observations.csv", [](Cells& cells) { cells[4] = "1e6"; });
  expect_refused({"orient", "case"}, "sigma_px is too large");
}

TEST_F(Cause, IsThatNoPhotosShareAPoint) {
  change_rows("observations.csv", [](Cells& cells) { cells[1] = cells[0] + cells[1]; });
  expect_refused({"orient", "case"}, "No two photos share 4 points");
}

TEST_F(Cause, IsPhotosFromBelowTheGround) {
  change_rows("photos.csv", [](Cells& cells) { cells[3] = "-" + cells[3]; });
  expect_refused({"orient", "case"}, "below the ground");
}

TEST_F(Cause, IsACorrelationOfOne) {
  std::string text = text_of(folder / "case/camera.toml");
  text += "[covariance]\norder = [\"f\", \"k1\"]\nmatrix = [[1, 0.01], [0.01, 0.0001]]\n";
  write_text(folder / "case/camera.toml", text);
  expect_refused({"orient", "case"}, "a correlation of 1 or beyond");
}

TEST_F(Cause, IsACaseInMillimetres) {
  change_rows("photos.csv", [](Cells& cells) {
    for (std::size_t i = 1; i < cells.size(); ++i) cells[i] = digits(1000 * std::stod(cells[i]));
  });
  EXPECT_THAT(warnings(), HasSubstr("in metres"));
}

// A lens that is given wrong draws the focal length with it. Set aside it is not said to be off by
// less than it was set aside for.
TEST_F(Cause, OfACalibrationSetAsideHasNoSizeInAFewSigmas) {
  std::string said;
  for (unsigned seed = 95; seed < 103; ++seed) {
    write_case({.seed = seed}, folder / "case");
    replace_in_camera("radial", "radial = [0.6, -6.0, 0.0]");
    said += warnings();
  }
  EXPECT_THAT(said, HasSubstr("contradicts photos and positions and was not used. Without it"));
  for (const char* few : {" (0.", " (1.", " (2."}) {
    for (std::size_t at = said.find(few); at != std::string::npos; at = said.find(few, at + 1)) {
      EXPECT_NE(said.substr(at + 5, 6), " sigma") << said.substr(at > 60 ? at - 60 : 0, 90);
    }
  }
}

}  // namespace
}  // namespace plumbline::acceptance
