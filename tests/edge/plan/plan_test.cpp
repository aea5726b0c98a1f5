// SPDX-License-Identifier: MIT
#include "edge/plan/plan.h"

#include <gmock/gmock.h>

#include <cmath>
#include <utility>

#include "edge/base/index.h"
#include "edge/plan/words.h"
#include "tests/edge/plan/paper_camera.h"

namespace plumbline::plan {
namespace {

using ::testing::HasSubstr;
using testing::paper_options;

Summary planned(const Flight& flight, const Options& options) {
  const auto summary = plan(flight, options);
  EXPECT_TRUE(summary.ok());
  return summary ? *summary : Summary{};
}

double larger(const Sigma& sigma) {
  if (!sigma.plan_m || !sigma.height_m) return 1e9;
  return std::max(*sigma.plan_m, *sigma.height_m);
}

TEST(Plan, AdvisesTheCheapestChangeThatReachesTheGoal) {
  Options options = paper_options(0.2);
  options.goal_m = 0.08;
  const Summary summary = planned(flight_of({70, 90, 5, {}}), options);
  EXPECT_FALSE(*summary.goal_reached);
  ASSERT_TRUE(summary.cheapest);
  const Advice& chosen = summary.advice[at(*summary.cheapest)];
  EXPECT_LE(larger(chosen.worst), 0.08);
  for (const Advice& advice : summary.advice) {
    if (advice.change.cost_s < chosen.change.cost_s) {
      EXPECT_FALSE(advice.reaches_goal) << advice.change.what;
    }
  }
  EXPECT_THAT(summary.sentence, HasSubstr("azimuth unknown"));
  EXPECT_THAT(summary.sentence, HasSubstr(chosen.change.what));
}

TEST(Plan, KeepsItsPromiseWhenTheChangeIsMade) {
  Options options = paper_options(0.2);
  options.goal_m = 0.08;
  const Flight flight = flight_of({70, 90, 5, {}});
  const Summary before = planned(flight, options);
  ASSERT_TRUE(before.cheapest);
  const Change& change = before.advice[at(*before.cheapest)].change;
  options.radius_m = before.radius_m;
  const Summary after = planned(changed(flight, change), changed(options, change));
  EXPECT_TRUE(*after.goal_reached);
  EXPECT_NEAR(larger(after.worst), larger(before.advice[at(*before.cheapest)].worst), 1e-9);
}

TEST(Plan, SaysThatAReachedGoalNeedsNothing) {
  Options options = paper_options(0.1);
  options.goal_m = 0.1;
  const Summary summary = planned(flight_of(*named_climb("standard")), options);
  EXPECT_TRUE(*summary.goal_reached);
  EXPECT_THAT(summary.sentence, HasSubstr("nothing to change"));
}

TEST(Plan, SaysThatNothingReachesAGoalBeyondThePositions) {
  Options options = paper_options(0.2);
  options.goal_m = 0.0005;
  const Summary summary = planned(flight_of({70, 90, 5, {}}), options);
  EXPECT_FALSE(summary.cheapest);
  ASSERT_TRUE(summary.best);
  EXPECT_THAT(summary.sentence, HasSubstr("Nothing tried reaches the goal"));
  for (const Advice& advice : summary.advice) {
    EXPECT_GE(larger(advice.worst), 0.99 * larger(summary.advice[at(*summary.best)].worst));
  }
}

// A goal in metres, of local sigmas, says nothing of where the whole lies and which way it is
// turned.
TEST(Plan, SaysWhatStaysUnobservableWhereAGoalIsReachedOrCouldBe) {
  Options options = paper_options(0.2);
  options.rtk.reset();
  options.known_length_m = 20;
  for (const double goal_m : {10.0, 0.05, 0.0001}) {
    options.goal_m = goal_m;
    const Summary summary = planned(flight_of({70, 90, 5, {}}), options);
    const std::size_t from = summary.sentence.find("ot observable");
    ASSERT_NE(from, std::string::npos) << summary.sentence;
    EXPECT_THAT(summary.sentence.substr(from), HasSubstr("azimuth")) << goal_m;
    EXPECT_THAT(summary.sentence.substr(from), HasSubstr("position")) << goal_m;
  }
}

TEST(Plan, NamesAGoalOfMicrometresAsItIs) {
  EXPECT_EQ(length_in_words(1e-6), "0.001 mm");
  EXPECT_EQ(length_in_words(0.00004), "0.04 mm");
  EXPECT_EQ(length_in_words(0.0042), "4.2 mm");
  EXPECT_EQ(length_in_words(0.042), "4.2 cm");
  EXPECT_EQ(length_in_words(std::nullopt), "unknown");
}

TEST(Plan, AdvisesNothingThatLeavesAsMuchUnobservable) {
  for (const double sigma_px : {0.1, 0.3, 1.0, 3.0}) {
    for (const bool rtk : {false, true}) {
      Options options = paper_options(sigma_px);
      if (!rtk) options.rtk.reset();
      const Summary summary = planned(flight_of({70, 90, 5, {}}), options);
      if (!summary.cheapest) {
        EXPECT_THAT(summary.sentence, HasSubstr("No single change")) << sigma_px;
        continue;
      }
      EXPECT_LT(summary.advice[at(*summary.cheapest)].unobservable.size(),
                summary.flight.unobservable.size())
          << sigma_px;
    }
  }
}

TEST(Plan, TriesPairsWhereNoSingleChangeDoes) {
  Options options = paper_options(0.3);
  options.goal_m = 0.035;
  const Summary summary = planned(flight_of({70, 90, 5, {}}), options);
  ASSERT_TRUE(summary.cheapest);
  EXPECT_THAT(summary.advice[at(*summary.cheapest)].change.what, HasSubstr(", and "));
}

TEST(Plan, AdvisesOnWhatIsNotObservableWithoutAGoal) {
  const Summary summary = planned(flight_of({70, 90, 5, {}}), paper_options(0.2));
  EXPECT_FALSE(summary.goal_reached);
  ASSERT_TRUE(summary.cheapest);
  const Advice& advice = summary.advice[at(*summary.cheapest)];
  EXPECT_LT(advice.unobservable.size(), summary.flight.unobservable.size());
  EXPECT_TRUE(advice.azimuth_deg);
}

TEST(Plan, StatesTheStandardAccuracyOverTheClimbAsBase) {
  const Summary summary = planned(flight_of({70, 90, 5, {}}), paper_options(1));
  ASSERT_TRUE(summary.standard_accuracy);
  EXPECT_NEAR(summary.standard_accuracy->plan_m, 80.0 / 2125, 1e-12);
  EXPECT_NEAR(summary.standard_accuracy->height_m, std::sqrt(2.0) * 80 / 2125 * 80 / 20, 1e-12);
}

// A daemon asks after each photo: what was flown stays, and the rest may still change.
TEST(Plan, PlansOnFromThePhotosAlreadyTaken) {
  const Flight whole = flight_of({70, 90, 5, {10}});
  Options options = paper_options(0.2);
  options.goal_m = 0.12;
  options.radius_m = 40;
  Flight flight;
  double before = 1e9;
  for (const Eigen::Vector3d& place : whole.ahead_m) {
    flight.taken_m.push_back(place);
    if (flight.photos() < 2) continue;
    const Summary summary = planned(flight, options);
    const double now = summary.worst.height_m.value_or(1e9);
    EXPECT_LT(now, before);
    before = now;
    EXPECT_EQ(*summary.goal_reached, flight.photos() == whole.photos());
  }
  Flight ahead = whole;
  EXPECT_NEAR(*planned(ahead, options).worst.height_m, before, 1e-9);
}

// A position that says of itself what the options say of all is no other.
TEST(Plan, TakesTheFixOfEachPhotoInPlaceOfTheUsualOne) {
  Options options = paper_options(0.2);
  options.radius_m = 30;
  Flight flight = flight_of({70, 90, 5, {10}});
  flight.taken_m = std::exchange(flight.ahead_m, {});
  const Sigma usual = planned(flight, options).worst;
  options.rtk.reset();
  flight.taken_fixes.assign(flight.taken_m.size(), PhotoFix{});
  for (PhotoFix& fix : flight.taken_fixes) {
    fix.covariance_m2 = Eigen::Vector3d(25e-6, 25e-6, 1e-4).asDiagonal();
  }
  const Summary own = planned(flight, options);
  EXPECT_TRUE(own.flight.georeferenced);
  EXPECT_NEAR(*own.worst.plan_m, *usual.plan_m, 1e-9);
  EXPECT_NEAR(*own.worst.height_m, *usual.height_m, 1e-9);
  for (PhotoFix& fix : flight.taken_fixes) fix.covariance_m2 *= 100;
  EXPECT_GT(*planned(flight, options).worst.height_m, 3 * *usual.height_m);
}

// All photos are off by velocity times delay: of a climb, in height.
TEST(Plan, LetsADelayMoveAllPhotosOfAClimbAlike) {
  Options options = paper_options(0.2);
  options.radius_m = 30;
  const Flight flight = flight_of({70, 90, 5, {}});
  const double without_m = *planned(flight, options).worst.height_m;
  options.delay_sigma_s = 0.03;
  const double with_m = *planned(flight, options).worst.height_m;
  const double delay_m = 0.03 * options.costs.climb_rate_m_s;
  EXPECT_NEAR(with_m, std::hypot(without_m, delay_m), 0.02 * with_m);
}

TEST(Plan, KeepsChangesToWhatADroneInTheAirWouldPhotograph) {
  Options options = paper_options(0.2);
  options.ceiling_m = 90;
  options.floor_m = 70;
  options.least_aside_m = 10;
  options.photos_between = false;
  for (const Change& change : single_changes(flight_of({70, 90, 5, {}}), options)) {
    EXPECT_TRUE(change.photos_m.empty() || change.aside_m >= 10) << change.what;
  }
}

TEST(Plan, IsTheSameBitsTwice) {
  Options options = paper_options(0.2);
  options.goal_m = 0.05;
  const Summary a = planned(flight_of({70, 90, 5, {5}}), options);
  const Summary b = planned(flight_of({70, 90, 5, {5}}), options);
  ASSERT_EQ(a.advice.size(), b.advice.size());
  for (std::size_t i = 0; i < a.advice.size(); ++i) {
    EXPECT_EQ(a.advice[i].worst.height_m, b.advice[i].worst.height_m);
  }
}

TEST(Plan, RefusesNonsenseInOneSentence) {
  Options options = paper_options(0.2);
  options.goal_m = -1;
  EXPECT_FALSE(plan(flight_of({70, 90, 5, {}}), options));
  options = paper_options(0.2);
  options.known_length_m = 1000;
  EXPECT_FALSE(plan(flight_of({70, 90, 5, {}}), options));
  EXPECT_FALSE(plan(Flight{}, paper_options(0.2)));
  options = paper_options(0.2);
  options.delay_sigma_s = -1;
  EXPECT_FALSE(plan(flight_of({70, 90, 5, {}}), options));
  Flight flight = flight_of({70, 90, 5, {}});
  flight.taken_m = std::exchange(flight.ahead_m, {});
  flight.taken_fixes.resize(1);
  EXPECT_FALSE(plan(flight, paper_options(0.2))) << "one fix for five photos";
  flight.taken_fixes.resize(5);
  flight.taken_fixes[2].covariance_m2(0, 0) = -1;
  EXPECT_FALSE(plan(flight, paper_options(0.2)));
  EXPECT_FALSE(check(Climb{90, 70, 5, {}}));
  EXPECT_FALSE(check(Climb{70, 90, 0, {}}));
}

}  // namespace
}  // namespace plumbline::plan
