// SPDX-License-Identifier: MIT
// Flights by hand, without noise: five fixes a second that arrive 80 ms late, and frames, ten a
// second, of which each is exposed when it is due. The ground is at 50 m.
#include "edge/capture/decider.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace plumbline::capture {
namespace {

using std::chrono::milliseconds;

constexpr double kStands_m = 50;
constexpr milliseconds kFixArrives{80};
const UtcTime kMidday =
    std::chrono::sys_days(std::chrono::year(2026) / 11 / 20) + std::chrono::hours(12);

HostTime second(double seconds) {
  return HostTime(std::chrono::nanoseconds(std::llround(1e9 * seconds)));
}

// Height above the ground: stands until second 20, then 2 m/s.
double climbs_m(double time_s) { return std::max(0.0, 2 * (time_s - 20)); }

class FlightByHand {
 public:
  explicit FlightByHand(const CaptureOptions& options) : decider_(options) {
    hear(0, Started{});
    hear(0, CameraSeen{true});
  }

  void hear(double time_s, Happening what) {
    decider_.take({second(time_s), std::move(what)}, decisions_);
  }

  // What arrives between the two times, a tenth of a second at a time.
  void fly(double from_s, double until_s) {
    for (int k = static_cast<int>(std::lround(10 * from_s)); k < std::lround(10 * until_s); ++k) {
      const double time_s = 0.1 * k;
      if (k % 2 == 0 && positions) hear_fix(time_s);
      if (pilot_heights && k % 5 == 0) {
        hear(time_s + 0.03, PilotHeightSeen{height_m(time_s), k > 200 ? 2.0 : 0.0});
      }
      if (frames) hear_frame(time_s);
      hear(time_s + 0.099, Tick{});
    }
  }

  template <typename T>
  std::vector<T> all() const {
    std::vector<T> found;
    for (const Decision& decision : decisions_) {
      if (const auto* what = std::get_if<T>(&decision.what)) found.push_back(*what);
    }
    return found;
  }

  std::vector<double> heights_taken_m() const {
    std::vector<double> heights_m;
    for (const PhotoTaken& taken : all<PhotoTaken>()) {
      if (taken.target.reason == Reason::kHeight) heights_m.push_back(taken.target.height_m);
    }
    return heights_m;
  }

  Phase phase() const { return decider_.phase(); }

  std::function<double(double time_s)> height_m = climbs_m;
  bool positions = true;
  bool frames = true;
  bool pilot_heights = false;

 private:
  void hear_fix(double time_s) {
    GnssFix fix;
    fix.time = kMidday + std::chrono::microseconds(std::llround(1e6 * time_s));
    fix.quality = FixQuality::kFixed;
    fix.latitude_deg = 35.66;
    fix.longitude_deg = 139.76;
    fix.height_ellipsoidal_m = kStands_m + height_m(time_s);
    fix.covariance_enu_m2 = Eigen::Vector3d(0.01, 0.01, 0.02).cwiseAbs2().asDiagonal();
    const HostTime arrival = second(time_s) + kFixArrives;
    decider_.take({arrival, FixHeard{fix, arrival, false}}, decisions_);
  }

  void hear_frame(double time_s) {
    FrameSeen frame;
    frame.sequence = ++frames_;
    frame.timing = {second(time_s), milliseconds(1), {}, std::chrono::microseconds(200)};
    frame.rows = 1;
    hear(time_s + 0.09, frame);
  }

  Decider decider_;
  std::vector<Decision> decisions_;
  std::uint64_t frames_ = 0;
};

CaptureOptions plan_by(TakeOffBy by) {
  CaptureOptions options;
  options.plan.heights_m = {30, 35, 40, 45};
  options.plan.aside_m.reset();
  options.take_off.by = by;
  return options;
}

// Armed at second 2, the first position at second 10, standing until 20.
TEST(Decider, CountsHeightsFromTheGroundWhereItWasArmedBeforeTheFirstPosition) {
  FlightByHand flight(plan_by(TakeOffBy::kArmed));
  flight.positions = false;
  flight.fly(0, 2);
  flight.hear(2, PilotSeen{true});
  flight.fly(2, 10);
  EXPECT_EQ(flight.phase(), Phase::kFlying);
  flight.positions = true;
  flight.fly(10, 45);
  EXPECT_EQ(flight.heights_taken_m(), (std::vector<double>{30, 35, 40, 45}));
  const auto found = flight.all<GroundFound>();
  ASSERT_EQ(found.size(), 2u);  // once there is one, and when it is left
  EXPECT_NEAR(found.back().ground_height_m, kStands_m, 0.05);
}

// Without a position photos are by time; the first position comes in the air, 28 m above the
// ground, as the autopilot knows, to the metre that the drone climbs between two of its messages.
TEST(Decider, FindsTheGroundBelowAFirstPositionInTheAirByWhatTheAutopilotSays) {
  FlightByHand flight(plan_by(TakeOffBy::kArmed));
  flight.positions = false;
  flight.pilot_heights = true;
  flight.hear(0.5, PilotSeen{true});
  flight.fly(1, 34);
  for (const PhotoTaken& blind : flight.all<PhotoTaken>()) {
    EXPECT_EQ(blind.target.reason, Reason::kBlind);
    EXPECT_TRUE(blind.marks.no_position);
  }
  EXPECT_GT(flight.all<PhotoTaken>().size(), 10u);
  flight.positions = true;
  flight.fly(34, 45);
  EXPECT_EQ(flight.heights_taken_m(), (std::vector<double>{30, 35, 40, 45}));
  for (const PhotoTaken& taken : flight.all<PhotoTaken>()) {
    if (!taken.place) continue;
    const double exposed_s =
        std::chrono::duration<double>(taken.exposed.time_since_epoch()).count();
    EXPECT_NEAR(taken.place->height_m, climbs_m(exposed_s), 1.3) << taken.number;
  }
}

TEST(Decider, TakesOffByTheReceiverWhereNoAutopilotIsHeard) {
  for (const TakeOffBy by : {TakeOffBy::kArmed, TakeOffBy::kRelativeAltitude}) {
    FlightByHand flight(plan_by(by));
    flight.fly(0, 45);
    EXPECT_EQ(flight.phase(), Phase::kFlying);
    EXPECT_EQ(flight.heights_taken_m(), (std::vector<double>{30, 35, 40, 45}));
  }
}

// The heartbeat ceases in the air, and the drone comes down: it has landed by the receiver.
TEST(Decider, LandsByTheReceiverWhereTheAutopilotFellSilent) {
  FlightByHand flight(plan_by(TakeOffBy::kArmed));
  flight.height_m = [](double time_s) {
    return time_s < 40 ? climbs_m(time_s) : std::max(0.0, 40 - 4 * (time_s - 40));
  };
  flight.hear(0.5, PilotSeen{true});
  flight.fly(1, 35);
  flight.hear(35, PilotSeen{});
  flight.fly(35, 49);
  EXPECT_EQ(flight.phase(), Phase::kFlying);
  flight.fly(49, 60);
  EXPECT_EQ(flight.phase(), Phase::kLanded);
}

TEST(Decider, TakesOffByTheAutopilotsAltitudeWhereAskedTo) {
  FlightByHand flight(plan_by(TakeOffBy::kRelativeAltitude));
  flight.pilot_heights = true;
  flight.fly(0, 22.9);  // 3 m at second 21.5, and 2 s of it
  EXPECT_EQ(flight.phase(), Phase::kReady);
  flight.fly(22.9, 45);
  EXPECT_EQ(flight.phase(), Phase::kFlying);
  EXPECT_EQ(flight.heights_taken_m(), (std::vector<double>{30, 35, 40, 45}));
}

// The camera is away from 33 to 43 m above the ground: 35 and 40 m went by. On the way down they
// are taken.
TEST(Decider, SaysWhichHeightsWereLeftBehind) {
  FlightByHand flight(plan_by(TakeOffBy::kHeight));
  flight.height_m = [](double time_s) {
    return time_s < 45 ? climbs_m(time_s) : 50 - 2 * (time_s - 45);
  };
  flight.fly(0, 36.5);
  flight.frames = false;
  flight.hear(36.5, CameraSeen{false});
  flight.fly(36.5, 41.6);
  flight.hear(41.6, CameraSeen{true});
  flight.frames = true;
  flight.fly(41.6, 45);
  EXPECT_EQ(flight.heights_taken_m(), (std::vector<double>{30, 45}));
  const auto left = flight.all<HeightPassed>();
  ASSERT_EQ(left.size(), 2u);
  EXPECT_EQ(left[0].target.height_m, 35);
  EXPECT_EQ(left[1].target.height_m, 40);
  flight.fly(45, 60);
  EXPECT_EQ(flight.heights_taken_m(), (std::vector<double>{30, 45, 40, 35}));
  EXPECT_EQ(flight.all<HeightPassed>().size(), 2u);
}

// The photo at 35 m is lost on its way to the disk a second later, when it is 2 m higher: its
// height is open again.
TEST(Decider, TakesAHeightAgainWhosePhotoWasLost) {
  FlightByHand flight(plan_by(TakeOffBy::kHeight));
  flight.fly(0, 38.5);
  ASSERT_EQ(flight.heights_taken_m(), (std::vector<double>{30, 35}));
  flight.hear(38.5, PhotoLost{2});
  ASSERT_EQ(flight.all<PhotoMissed>().size(), 1u);
  EXPECT_EQ(flight.all<PhotoMissed>()[0].number, 2);
  EXPECT_EQ(flight.all<PhotoMissed>()[0].target.height_m, 35);
  flight.fly(38.5, 45);
  EXPECT_EQ(flight.heights_taken_m(), (std::vector<double>{30, 35, 35, 40, 45}));
  EXPECT_TRUE(flight.all<PhotoTaken>()[2].marks.late);
}

}  // namespace
}  // namespace plumbline::capture
