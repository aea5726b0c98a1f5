// SPDX-License-Identifier: MIT
#include "firmware/service/advice/adviser.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <condition_variable>
#include <fstream>
#include <string>
#include <vector>

#include "firmware/ingest/camera_toml.h"
#include "tests/firmware/ingest/temporary_folder.h"

namespace plumbline::service {
namespace {

using ::testing::AllOf;
using ::testing::EndsWith;
using ::testing::HasSubstr;
using ::testing::Not;
using ::testing::StartsWith;

AdviserOptions calibrated() {
  AdviserOptions options;
  geometry::Camera& camera = options.plan.camera;
  camera.width_px = 4000;
  camera.height_px = 2250;
  camera.interior << 2125, 1999.5, 1124.5, 0, 0, 0, 0, 0, 0, 0;
  camera.sigma.setZero();
  options.plan.goal_m = 0.05;
  return options;
}

geodesy::LocalFrame here() { return *geodesy::LocalFrame::at({35.66, 139.76, 52.3}); }

// By a fixed solution of 5 and 10 mm, for its height of the plan where that has it.
capture::PhotoTaken taken_at(double east_m, double height_m) {
  capture::PhotoTaken taken;
  const auto& heights_m = capture::CapturePlan{}.heights_m;
  const auto height = std::find(heights_m.begin(), heights_m.end(), height_m);
  if (east_m == 0 && height != heights_m.end()) {
    taken.target.entry = static_cast<int>(height - heights_m.begin());
  } else if (east_m != 0) {
    taken.target.reason = capture::Reason::kAside;
  }
  taken.place.emplace();
  taken.place->in_enu_m = {east_m, 0, height_m};
  taken.place->covariance_m2 = Eigen::Vector3d(25e-6, 25e-6, 1e-4).asDiagonal();
  taken.place->height_m = height_m;
  taken.place->quality = FixQuality::kFixed;
  return taken;
}

FlownPhoto flown_at(double east_m, double height_m) {
  return *flown_photo(taken_at(east_m, height_m), here());
}

std::vector<FlownPhoto> flown_up(double from_m, double to_m) {
  std::vector<FlownPhoto> photos;
  for (double height_m = from_m; height_m <= to_m; height_m += 5) {
    photos.push_back(flown_at(0, height_m));
  }
  return photos;
}

void make_float(FlownPhoto& photo) {
  photo.quality = FixQuality::kFloat;
  photo.covariance_m2 = Eigen::Vector3d(0.09, 0.09, 0.36).asDiagonal();
}

class AskedAdviser : public testing::Test {
 protected:
  AskedAdviser() : adviser_(calibrated(), [this](const Advice& advice) { keep(advice); }) {}

  void fly() {
    adviser_.decided({HostTime{}, capture::PhaseChanged{capture::Phase::kFlying, 0.0}}, here());
  }

  void photograph(double east_m, double height_m) {
    adviser_.decided({HostTime{}, taken_at(east_m, height_m)}, here());
  }

  // The next advice; none after a minute.
  Advice next() {
    std::unique_lock lock(mutex_);
    changed_.wait_for(lock, std::chrono::minutes(1), [this] { return given_ < advice_.size(); });
    return given_ < advice_.size() ? advice_[given_++] : Advice{};
  }

 private:
  void keep(const Advice& advice) {
    EXPECT_LE(advice.short_text.size(), 50u) << advice.short_text;
    const std::lock_guard lock(mutex_);
    advice_.push_back(advice);
    changed_.notify_all();
  }

  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Advice> advice_;
  std::size_t given_ = 0;

 protected:
  Adviser adviser_;  // the last: it ends before what it calls
};

// papers/vertical.md: photos on one vertical line say nothing about north.
TEST_F(AskedAdviser, SendsAClimbWithoutASideStepAside) {
  fly();
  photograph(0, 70);
  photograph(0, 80);
  next();
  photograph(0, 90);
  const Advice advice = next();
  EXPECT_THAT(advice.sentence, AllOf(HasSubstr("azimuth unknown"), HasSubstr(" m aside")));
  EXPECT_THAT(advice.short_text, HasSubstr(": go "));
}

TEST_F(AskedAdviser, LetsAFlightLandThatReachesItsGoal) {
  fly();
  for (int height_m = 30; height_m <= 90; height_m += 10) photograph(0, height_m);
  photograph(10, 90);
  photograph(20, 90);
  Advice last = next();
  for (Advice more = last;
       !more.sentence.empty() && more.sentence.find("land") == std::string::npos;)
    last = more = next();
  EXPECT_THAT(last.sentence, AllOf(HasSubstr(": good, land."), Not(HasSubstr("unknown"))));
}

TEST_F(AskedAdviser, ForgetsTheFlightBefore) {
  fly();
  photograph(0, 70);
  photograph(10, 70);
  EXPECT_THAT(next().sentence, Not(HasSubstr("azimuth unknown")));
  fly();
  photograph(0, 70);
  photograph(0, 90);
  EXPECT_THAT(next().sentence, HasSubstr("azimuth unknown"));
}

TEST_F(AskedAdviser, GoesOnWithThePhotosOfAFlightThatWasInterrupted) {
  adviser_.remember(flown_up(30, 85));
  fly();
  photograph(0, 90);
  EXPECT_EQ(next().sentence, advise(flown_up(30, 90), calibrated())->sentence);
  fly();
  photograph(0, 30);
  photograph(0, 35);
  EXPECT_EQ(next().sentence, advise(flown_up(30, 35), calibrated())->sentence);
}

TEST_F(AskedAdviser, DropsThePhotosOfAnInterruptedFlightThatIsOver) {
  adviser_.remember(flown_up(30, 85));
  adviser_.decided({HostTime{}, capture::PhaseChanged{capture::Phase::kLanded, 0.0}}, here());
  fly();
  photograph(0, 30);
  photograph(0, 35);
  EXPECT_EQ(next().sentence, advise(flown_up(30, 35), calibrated())->sentence);
}

// After two photos of thirteen the whole climb is what the flight will have measured.
TEST(Advice, CountsThePhotosThatAreStillToCome) {
  const auto advice = advise(flown_up(30, 35), calibrated());
  ASSERT_TRUE(advice);
  const auto whole = advise(flown_up(30, 90), calibrated());
  const std::string at_the_top = whole->short_text.substr(7, whole->short_text.find(" cm") - 4);
  EXPECT_THAT(advice->short_text, StartsWith("So far height "));
  EXPECT_THAT(advice->short_text, EndsWith("; " + at_the_top + " at the top"));
  EXPECT_THAT(advice->sentence, Not(HasSubstr("climb on")));
}

TEST(Advice, CountsOnlyWhatIsTakenOnceTheDroneHasGoneAside) {
  std::vector<FlownPhoto> photos = flown_up(30, 60);
  photos.push_back(flown_at(5, 60));
  EXPECT_TRUE(heights_to_come({}, photos).empty());
  EXPECT_THAT(advise(photos, calibrated())->short_text, StartsWith("Height "));
  photos.push_back(flown_at(0, 65));  // it climbs on after all
  EXPECT_EQ(heights_to_come({}, photos), (std::vector<double>{70, 75, 80, 85, 90}));
}

TEST(Advice, CountsTheWayDownWhereThePlanTakesPhotosThere) {
  capture::CapturePlan plan;
  plan.heights_m = {30, 60, 90};
  plan.direction = capture::Direction::kBoth;
  FlownPhoto photo = flown_at(0, 60);
  photo.target.entry = 1;
  EXPECT_EQ(heights_to_come(plan, {photo}), (std::vector<double>{90, 90, 60, 30}));
  photo.target.entry = 4;
  EXPECT_EQ(heights_to_come(plan, {photo}), (std::vector<double>{30}));
}

// The daemon photographs the heights of its plan: up there it would take none.
TEST(Advice, SendsNobodyWhereNoPhotoIsTaken) {
  config::Config config;
  config.capture.plan.heights_m = {30, 40, 50};
  config.capture.plan.aside_m = 10;
  const plan::Options options = adviser_options(config)->plan;
  plan::Flight flight;
  for (const double height_m : config.capture.plan.heights_m) {
    flight.taken_m.emplace_back(0, 0, height_m);
  }
  for (const plan::Change& change : plan::single_changes(flight, options)) {
    for (const Eigen::Vector3d& place : change.photos_m) EXPECT_LE(place.z(), 50) << change.what;
    EXPECT_FALSE(change.step_m) << change.what;
    EXPECT_TRUE(change.aside_m == 0 || change.aside_m >= 10) << change.what;
  }
}

Outlook with_change(const plan::Change& change) {
  Outlook outlook;
  outlook.photos = 3;
  outlook.flight.worst = {0.123, 0.123};
  outlook.flight.goal_reached = false;
  outlook.flight.flight.unobservable.push_back({"azimuth", ""});
  outlook.flight.advice.push_back({change, {0.01, 0.01}, 1.0, {}, true});
  outlook.flight.cheapest = 0;
  return outlook;
}

// Each kind, and each pair, in the fifty characters that an autopilot shows.
TEST(Advice, TellsThePilotWhatToDoForEveryChangeThatThePlannerKnows) {
  plan::Flight flight = plan::flight_of({70, 90, 5, {}});
  plan::Options options = calibrated().plan;
  options.radius_m = 30;
  const auto singles = plan::single_changes(flight, options);
  auto changes = plan::paired_changes(singles);
  changes.insert(changes.end(), singles.begin(), singles.end());
  for (const plan::Change& change : changes) {
    const Advice advice = advice_of(with_change(change));
    EXPECT_LE(advice.short_text.size(), 50u) << advice.short_text;
    EXPECT_THAT(
        advice.short_text,
        testing::ContainsRegex("(climb to [0-9]+ m|go down to [0-9]+ m|photos every [0-9.]+ "
                               "m|go [0-9]+ m aside|fly an L of [0-9]+ m|needs a )"))
        << change.what;
    EXPECT_THAT(advice.sentence, HasSubstr(change.what));
  }
}

TEST(Advice, SaysShortlyWhatTheGroundAloneCanGive) {
  plan::Change length, control, heading;
  length.known_length_m = 30;
  control.control_points = 1;
  heading.heading_sigma_deg = 2;
  EXPECT_THAT(advice_of(with_change(length)).short_text, EndsWith(": needs a known length"));
  EXPECT_THAT(advice_of(with_change(control)).short_text, EndsWith("needs a control point"));
  EXPECT_THAT(advice_of(with_change(heading)).short_text, EndsWith("needs a 2-degree compass"));
}

TEST(Advice, PrefersWhatADroneInTheAirCanDoWhereNothingReachesTheGoal) {
  plan::Change control, aside;
  control.control_points = 1;
  aside.aside_m = 10;
  aside.photos_m = {{10, 0, 90}};
  Outlook outlook = with_change(control);
  outlook.flight.cheapest.reset();
  outlook.flight.best = 0;
  outlook.flight.advice.push_back({aside, {0.08, 0.08}, 1.0, {}, false});
  EXPECT_THAT(advice_of(outlook).short_text, EndsWith(": go 10 m aside"));
}

TEST(Advice, SaysUnknownWhereNoFigureIs) {
  Outlook outlook = with_change({});
  outlook.flight.cheapest.reset();
  outlook.flight.worst = {};
  EXPECT_EQ(advice_of(outlook).short_text, "Height unknown, azimuth unknown: no change helps");
  outlook.now = plan::Prediction{};
  EXPECT_EQ(advice_of(outlook).short_text, "So far height unknown; unknown at the top");
}

double height_sigma_m(const std::vector<FlownPhoto>& photos) {
  const auto prediction =
      plan::predict(flight_of(photos, {}, 0), calibrated().plan, plan::Detail::kRepresentative);
  return prediction ? plan::worst_ring(*prediction).height_m.value_or(1e9) : 1e9;
}

// Twelve fixed positions are worth what they are worth without a thirteenth.
TEST(Advice, LetsOneFloatPhotoAtTheEndChangeNothingMuch) {
  std::vector<FlownPhoto> photos = flown_up(30, 90);
  const double fixed_m = height_sigma_m(photos);
  make_float(photos.back());
  EXPECT_GE(height_sigma_m(photos), fixed_m);
  EXPECT_LE(height_sigma_m(photos), 1.25 * fixed_m);
  EXPECT_THAT(advise(photos, calibrated())->sentence,
              EndsWith(" 1 of 13 photos have no fixed position."));
}

TEST(Advice, LetsOneFixedPhotoAtTheEndHideNoFloatOnes) {
  std::vector<FlownPhoto> photos = flown_up(30, 90);
  const double fixed_m = height_sigma_m(photos);
  for (auto photo = photos.begin(); photo != photos.end() - 1; ++photo) make_float(*photo);
  EXPECT_GE(height_sigma_m(photos), 5 * fixed_m);
  EXPECT_THAT(advise(photos, calibrated())->sentence,
              EndsWith(" 12 of 13 photos have no fixed position."));
}

// Its figures are those of a photo whose receiver has no corrections.
TEST(Advice, TrustsNoPositionThatHasJumped) {
  std::vector<FlownPhoto> photos = flown_up(70, 90);
  capture::PhotoTaken aside = taken_at(10, 90);
  photos.push_back(*flown_photo(aside, here()));
  const auto trusted = advise(photos, calibrated());
  aside.marks.jumped = true;
  photos.back() = *flown_photo(aside, here());
  const auto jumped = advise(photos, calibrated());
  aside.marks.jumped = false;
  aside.place->quality = FixQuality::kNone;
  aside.place->covariance_m2.setZero();
  photos.back() = *flown_photo(aside, here());
  const auto alone = advise(photos, calibrated());
  ASSERT_TRUE(trusted && jumped && alone);
  EXPECT_THAT(jumped->sentence, EndsWith("1 of 6 photos have no fixed position."));
  EXPECT_EQ(jumped->sentence, alone->sentence);
  EXPECT_NE(jumped->short_text, trusted->short_text);
}

// An ice survey of an hour, every ten seconds: what its last four minutes tell.
TEST(Advice, IsGivenForAFlightOfHundredsOfPhotos) {
  std::vector<FlownPhoto> photos;
  for (int k = 0; k < 360; ++k) {
    capture::PhotoTaken taken = taken_at(20.0 * (k % 30), 50);
    taken.place->in_enu_m.y() = 20.0 * (k / 30);
    taken.target = {capture::Reason::kTime, -1, 0};
    photos.push_back(*flown_photo(taken, here()));
  }
  AdviserOptions options = calibrated();
  options.capture.heights_m.clear();
  options.capture.every = std::chrono::seconds(10);
  const auto advice = advise(photos, options);
  const auto last = advise({photos.end() - 25, photos.end()}, options);
  ASSERT_TRUE(advice && last);
  EXPECT_EQ(advice->sentence, last->sentence);
}

TEST(Advice, IsGivenForAClimbOfHundredsOfPhotos) {
  AdviserOptions options = calibrated();
  options.capture.heights_m.clear();
  for (int k = 0; k <= 600; ++k) options.capture.heights_m.push_back(30 + 0.1 * k);
  std::vector<FlownPhoto> photos;
  for (int k = 0; k < 300; ++k) {
    photos.push_back(flown_at(0, 30 + 0.1 * k));
    photos.back().target.entry = k;
  }
  const auto advice = advise(photos, options);
  ASSERT_TRUE(advice);
  EXPECT_THAT(advice->sentence, AllOf(StartsWith("So far height"), HasSubstr("at the top")));
}

TEST(Advice, MeasuresShapeAloneWithoutAnyFixedPosition) {
  std::vector<FlownPhoto> photos = flown_up(30, 90);
  for (FlownPhoto& photo : photos) make_float(photo);
  EXPECT_TRUE(flight_of(photos, {}, 0).taken_fixes.empty());
  EXPECT_THAT(advise(photos, calibrated())->sentence, HasSubstr("Without a fixed position"));
}

// 30 ms at 2 m/s are 6 cm for all photos of a climb, of which none averages out.
TEST(Advice, CountsTheLatencyOfTheReceiverOnceForAllPhotos) {
  std::vector<FlownPhoto> photos = flown_up(30, 90);
  for (FlownPhoto& photo : photos) {
    photo.velocity_m_s = {0, 0, 2};
    photo.covariance_m2(2, 2) += 0.06 * 0.06;
  }
  const plan::Flight flight = flight_of(photos, {}, 0.03);
  for (const plan::PhotoFix& fix : flight.taken_fixes) {
    EXPECT_LE(fix.covariance_m2(2, 2), 0.05 * 0.0037 + 1e-4);
    EXPECT_GE(fix.covariance_m2(2, 2), 0.99e-4);
  }
  plan::Options options = calibrated().plan;
  options.delay_sigma_s = 0.03;
  const auto prediction = plan::predict(flight, options, plan::Detail::kRepresentative);
  ASSERT_TRUE(prediction);
  EXPECT_GE(*plan::worst_ring(*prediction).height_m, 0.06);
  EXPECT_LE(*plan::worst_ring(*prediction).height_m, 0.09);
}

class ConfiguredAdviser : public testing::Test {
 protected:
  ingest::TemporaryFolder folder_;
  config::Config config_;
};

TEST_F(ConfiguredAdviser, TakesTheCalibrationWithAllThatItsFileKnows) {
  geometry::Camera camera = calibrated().plan.camera;
  camera.sigma.setConstant(0.5);
  geometry::InteriorMatrix covariance = geometry::InteriorMatrix::Identity();
  covariance(0, 1) = covariance(1, 0) = 0.9;
  camera.covariance = covariance;
  config_.camera.calibration = folder_ / "camera.toml";
  std::ofstream(config_.camera.calibration) << ingest::camera_toml(camera);
  const auto options = adviser_options(config_);
  ASSERT_TRUE(options);
  ASSERT_TRUE(options->plan.camera.covariance);
  EXPECT_EQ(*options->plan.camera.covariance, covariance);
  EXPECT_EQ(options->plan.camera.sigma[0], 1);
}

// A camera whose axis goes through a corner of the picture sees a quarter of the ground.
TEST_F(ConfiguredAdviser, HasAUsualLensInTheMiddleOfThePictureWithoutCalibration) {
  config_.camera.options.width_px = 4000;
  config_.camera.options.height_px = 2250;
  const auto options = adviser_options(config_);
  ASSERT_TRUE(options);
  const geometry::Camera& camera = options->plan.camera;
  EXPECT_EQ(camera.interior[geometry::kPrincipalU], 1999.5);
  EXPECT_EQ(camera.interior[geometry::kPrincipalV], 1124.5);
  EXPECT_GT(camera.sigma[geometry::kFocalLength], 0);
  EXPECT_TRUE(camera.sigma.allFinite());
}

TEST_F(ConfiguredAdviser, KnowsTheLatencyWherePulsesPerSecondTellIt) {
  EXPECT_EQ(adviser_options(config_)->latency_sigma_s, 0.03);
  config_.receiver.pps = "/dev/pps0";
  EXPECT_EQ(adviser_options(config_)->latency_sigma_s, 0);
}

TEST_F(ConfiguredAdviser, RefusesACalibrationForPicturesOfAnotherSize) {
  config_.camera.calibration = folder_ / "camera.toml";
  std::ofstream(config_.camera.calibration) << ingest::camera_toml(calibrated().plan.camera);
  config_.camera.options.width_px = 4000;
  config_.camera.options.height_px = 2250;
  EXPECT_TRUE(adviser_options(config_));
  config_.camera.options.height_px = 3000;
  const auto refused = adviser_options(config_);
  ASSERT_FALSE(refused);
  EXPECT_THAT(refused.error().sentence,
              AllOf(HasSubstr("4000 x 2250 pixels"), HasSubstr("3000 pixels high")));
}

TEST_F(ConfiguredAdviser, SaysWhereTheCalibrationCannotBeRead) {
  config_.camera.calibration = folder_ / "none.toml";
  EXPECT_FALSE(adviser_options(config_));
}

}  // namespace
}  // namespace plumbline::service
