// SPDX-License-Identifier: MIT
// What a user gets wrong: one clear sentence, a status that a script can see, nothing left behind.
#include <gmock/gmock.h>

#include "tests/firmware/commands/acceptance/flight_folder.h"

namespace plumbline::acceptance {
namespace {

using testing::HasSubstr;

class BadPhotos : public FlightTest {};

TEST_F(BadPhotos, AnEmptyFolderIsRefused) {
  expect_measure_refused({}, "There are no JPEG photos in 'photos'");
}

TEST_F(BadPhotos, AMissingFolderIsRefused) {
  expect_refused({"measure", "nowhere"}, "There is no file or folder 'nowhere'.");
}

TEST_F(BadPhotos, TextNamedAsPhotosIsRefused) {
  write_text(photos / "a.jpg", "no photo\n");
  write_text(photos / "b.jpg", "no photo either\n");
  expect_measure_refused({}, "'a.jpg' is not a JPEG photo");
}

TEST_F(BadPhotos, OnePhotoIsRefused) {
  copy_photos(1);
  expect_measure_refused({}, "There is only one usable photo, '0001.jpg'");
}

TEST_F(BadPhotos, OnePhotoAndItsExactCopyAreRefused) {
  copy_photos(1);
  fs::copy_file(photos / "0001.jpg", photos / "copy.jpg");
  expect_measure_refused({}, "'copy.jpg' is an exact copy of '0001.jpg'");
}

TEST_F(BadPhotos, OneSoundPhotoBesideACutOneIsRefused) {
  copy_photos(2);
  fs::resize_file(photos / "0002.jpg", fs::file_size(photos / "0002.jpg") / 2);
  expect_measure_refused({}, "Photo '0002.jpg' is damaged or cut short");
}

TEST_F(BadPhotos, ACameraOfAnotherSizeIsRefused) {
  copy_photos(2);
  write_text(camera,
             "width_px = 4000\nheight_px = 2250\nfocal_length_px = 2125.0\n"
             "principal_point_px = [1999.5, 1124.5]\n");
  expect_measure_refused({}, "4000 x 2250 pixels, but the photos have 720 x 405");
}

TEST_F(BadPhotos, AMissingCameraIsRefused) {
  copy_photos(2);
  fs::remove(camera);
  expect_measure_refused({}, "Cannot read 'camera.toml'");
}

TEST_F(BadPhotos, ACutPhotoAmongGoodOnesIsLeftOutAndSaid) {
  copy_photos();
  fs::resize_file(photos / "0003.jpg", fs::file_size(photos / "0003.jpg") * 2 / 3);
  ASSERT_EQ(measure({}).status, 0);
  EXPECT_EQ(summary()["photos_given"], 6);
  EXPECT_EQ(summary()["photos_used"], 5);
  EXPECT_THAT(lines_of(summary()["warnings"]), HasSubstr("'0003.jpg' is damaged or cut short"));
}

TEST_F(BadPhotos, TextAmongGoodPhotosIsLeftOutAndSaid) {
  copy_photos();
  write_text(photos / "notes.jpg", "wind from the north\n");
  ASSERT_EQ(measure({}).status, 0);
  EXPECT_EQ(summary()["photos_given"], 7);
  EXPECT_EQ(summary()["photos_used"], 6);
  EXPECT_THAT(lines_of(summary()["warnings"]), HasSubstr("'notes.jpg' is not a JPEG photo"));
}

TEST_F(BadPhotos, AnExactCopyAmongGoodPhotosIsLeftOutAndSaid) {
  copy_photos();
  fs::copy_file(photos / "0001.jpg", photos / "copy.jpg");
  ASSERT_EQ(measure({}).status, 0);
  EXPECT_EQ(summary()["photos_given"], 7);
  EXPECT_EQ(summary()["photos_used"], 6);
  EXPECT_THAT(lines_of(summary()["warnings"]), HasSubstr("exact copy of '0001.jpg'"));
}

class BadTables : public FlightTest {
 protected:
  void SetUp() override {
    FlightTest::SetUp();
    copy_photos(2);
  }
  void expect_picks_refused(const std::string& table, const std::string& sentence) {
    write_text(folder / "picks.csv", table);
    expect_measure_refused({"--picks", "picks.csv"}, sentence);
  }
};

TEST_F(BadTables, PicksAreRefusedWithFileAndLine) {
  const std::string head = "photo,point,u_px,v_px\n0001.jpg,A,100,100\n";
  expect_picks_refused("photo,point,u,v\n0001.jpg,A,1,2\n", "picks.csv:1: the column 'u_px'");
  expect_picks_refused(head + "0002.jpg,A,nan,100\n", "picks.csv:3: 'u_px' is 'nan'");
  expect_picks_refused(head + "0002.jpg,A,,100\n", "picks.csv:3: ");
  expect_picks_refused(head + "0002.jpg,A,12x,100\n", "picks.csv:3: 'u_px' is '12x'");
  expect_picks_refused(head + "0001.jpg,A,100,100\n", "picks.csv:3: the point 'A' is there twice");
  expect_picks_refused(head + "0009.jpg,A,100,100\n", "picks.csv:3: there is no photo '0009.jpg'");
  expect_picks_refused("", "picks.csv: the file is empty");
}

TEST_F(BadTables, APickFarOutsideThePhotoIsRefused) {
  expect_picks_refused("photo,point,u_px,v_px\n0001.jpg,A,100000,100\n",
                       "The pick of point 'A' lies far outside photo '0001.jpg'");
}

TEST_F(BadTables, MissingTablesAreRefused) {
  expect_measure_refused({"--picks", "none.csv"}, "Cannot read 'none.csv'");
  expect_measure_refused({"--check", "none.csv"}, "Cannot read 'none.csv'");
  expect_measure_refused({"--control", "none.csv"}, "Cannot read 'none.csv'");
  expect_measure_refused({"--gnss", "none.nmea"}, "Cannot read 'none.nmea'");
}

TEST_F(BadTables, LengthsAreRefusedUnlessTheyAreOne) {
  write_text(folder / "two.csv",
             "photo,point,u_px,v_px\n0001.jpg,P01,100,100\n0001.jpg,P02,99,99\n");
  const auto expect = [&](const std::string& length, const std::string& sentence) {
    expect_measure_refused({"--picks", "two.csv", "--length", length}, sentence);
  };
  expect("P01,P02", "'P01,P02' cannot be used");
  expect("P01,P02,nan", "'P01,P02,nan' cannot be used");
  expect("P01,P02,-3", "greater than 0 m");
  expect("P01,P01,3", "both ends");
}

TEST_F(BadTables, ALengthToAPointThatNobodyPickedIsRefused) {
  write_text(folder / "two.csv", "photo,point,u_px,v_px\n0001.jpg,A,100,100\n0002.jpg,A,99,99\n");
  expect_measure_refused({"--picks", "two.csv", "--length", "A,ZZ,10"},
                         "names a point that was not picked in any photo: ZZ");
}

TEST_F(BadTables, ChecksWithoutAnyMeasuredPointAreRefused) {
  expect_measure_refused({"--check", check.string()}, "None of the 16 check points");
}

class BadOutput : public FlightTest {
 protected:
  void SetUp() override {
    FlightTest::SetUp();
    copy_photos();
  }
};

TEST_F(BadOutput, AFileInTheWayIsKept) {
  write_text(folder / "taken", "mine\n");
  expect_refused({"measure", "photos", "--out", "taken", "--ties", "150"}, "'taken'");
  expect_refused({"measure", "photos", "--out", "taken/below", "--ties", "150"}, "'taken/below'");
}

TEST_F(BadOutput, AFullDiskIsSaidAndLeftEmpty) {
  const std::vector<std::string> shell{"unshare", "-rm", "sh", "-c"};
  auto probe = shell;
  probe.emplace_back("mkdir disk && mount -t tmpfs -o size=64k none disk");
  if (run_any(probe, folder).status != 0) {
    GTEST_SKIP() << "no small disk can be mounted here (unshare -rm, mount -t tmpfs)";
  }
  for (const std::string out : {"disk", "disk/result"}) {
    auto command = shell;
    command.push_back("mount -t tmpfs -o size=64k none disk && " PLUMBLINE_PROGRAM
                      " measure photos --camera camera.toml --ties 250 --out " +
                      out + "; status=$?; ls -A disk; exit $status");
    const Outcome outcome = run_any(command, folder);
    EXPECT_EQ(outcome.status, 1);
    EXPECT_EQ(outcome.out, "");
    EXPECT_EQ(outcome.err, "plumbline: The disk is full: no results were written to '" + out +
                               "'; free some space or choose another folder with --out.\n");
  }
}

class WrongUsage : public FolderTest {};

TEST_F(WrongUsage, EndsWithTwoAndOneSentence) {
  expect_refused({}, "plumbline: ", 2);
  expect_refused({"fly"}, "'fly'", 2);
  expect_refused({"measure"}, "PHOTOS is required", 2);
  expect_refused({"measure", "photos", "--foo"}, "--foo", 2);
  expect_refused({"measure", "photos", "--ties", "many"}, "--ties", 2);
  expect_refused({"orient"}, "CASE is required", 2);
  expect_refused({"plan"}, "--camera is required", 2);
  expect_refused({"sim"}, "OUT is required", 2);
}

TEST_F(WrongUsage, OfAThresholdIsToldWhatIsWanted) {
  for (const std::string command : {"measure", "orient"}) {
    for (const std::string number : {"nan", "inf", "-1", "0"}) {
      expect_refused({command, "case", "--max-azimuth-sigma", number},
                     "--max-azimuth-sigma: '" + number + "' is not a number above 0", 2);
    }
  }
  expect_refused({"orient", "case", "--paper", "--ground-flat", "nan"}, "--ground-flat: ", 2);
}

TEST_F(WrongUsage, OfANumberOfASimulationOrAShotIsNoNumber) {
  for (const std::string option : {"--from", "--to", "--step", "--side-step", "--side-direction"}) {
    expect_refused({"sim", "out", option, "nan"}, option + ": 'nan' is not a number from ", 2);
  }
  expect_refused({"sim", "out", "--rtk", "nan,0.01"}, "--rtk: 'nan' is not a number from ", 2);
  for (const std::string option : {"--exposure", "--gain", "--rate"}) {
    expect_refused({"camera", "shot", option, "nan"}, option + ": 'nan' is not a number from ", 2);
    expect_refused({"camera", "shot", option, "0"}, option + ": '0' is not a number from ", 2);
  }
}

TEST_F(WrongUsage, HelpOfEveryCommandHasAnExample) {
  for (const std::string command : {"measure", "orient", "plan", "sim", "gnss"}) {
    const Outcome outcome = run_plumbline({command, "--help"}, folder);
    EXPECT_EQ(outcome.status, 0);
    EXPECT_THAT(outcome.out, HasSubstr("Example: plumbline " + command + " "));
    EXPECT_EQ(outcome.err, "");
  }
  EXPECT_THAT(run_plumbline({"--help"}, folder).out, HasSubstr("Example: plumbline "));
}

TEST_F(WrongUsage, HelpOfOrientNamesTheFilesOfACaseAndTheStatuses) {
  const std::string help = run_plumbline({"orient", "--help"}, folder).out;
  for (const char* words :
       {"camera.toml", "photos.csv", "observations.csv", "lengths.csv", "control.csv", "check.csv",
        "frame.csv", "lever_arm.csv", "gnss.toml", "delay_s is positive where the photos were",
        "middle row", "Exit status: 0 good; 1 "})
    EXPECT_THAT(help, HasSubstr(words));
}

}  // namespace
}  // namespace plumbline::acceptance
