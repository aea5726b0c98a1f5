// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "edge/base/gnss_fix.h"
#include "edge/base/time.h"
#include "edge/capture/capture_plan.h"
#include "edge/capture/inputs.h"
#include "edge/geodesy/local_frame.h"
#include "edge/timing/antenna_predictor.h"
#include "edge/timing/clock_fit.h"
#include "edge/timing/height_filter.h"
#include "edge/timing/pps_fit.h"

namespace plumbline::capture {

// The antenna at an instant of the host's clock.
struct Motion {
  HostTime time;
  Eigen::Vector3d in_enu_m = Eigen::Vector3d::Zero();  // about the first position
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();  // of the position
  // Within the covariance, what the receiver's least latency leaves open: by so much the position
  // would be further along if it were longer by its sigma. One error, common to the flight.
  Eigen::Vector3d latency_shift_m = Eigen::Vector3d::Zero();
  double height_ellipsoidal_m = 0;
  FixQuality quality = FixQuality::kNone;
  nanoseconds age{};  // of the newest fix, at that instant
  bool reckoned = false;

  double climb_m_s() const { return velocity_m_s.z(); }
  double sigma_height_m() const;
};

struct NavigatorOptions {
  timing::ClockFitOptions clock;
  timing::PredictorOptions predictor;
  nanoseconds fresh = std::chrono::milliseconds(1200);  // an older fix is no longer "of late"
  nanoseconds reckon_for = std::chrono::seconds(5);     // by the last velocity, from the last fix
};

// Where the antenna is and will be, on the host's clock, as the deciding thread knows it: fixes and
// pulses in, motion out. Once fixes cease it goes on by the last velocity for a while. Times of day
// without a date are given the day nearest to the wall's. Deterministic; one thread.
class Navigator {
 public:
  explicit Navigator(const NavigatorOptions& options = {});

  void set_wall(WallTime wall, HostTime host) {
    wall_minus_host_ = wall.time_since_epoch() - host.time_since_epoch();
  }

  // True where the fix carried a usable position.
  bool add(const GnssFix& fix, HostTime first_byte);
  void add_pulse(HostTime edge);

  // What of a recorded input tells where the antenna is.
  void hear(const Input& input);

  // Empty before the first positions, and when they are too long ago.
  std::optional<Motion> at(HostTime time) const;

  // The position did not go on from where it was, and has not come back: which of the two was wrong
  // nobody knows. A change of quality is no jump.
  bool has_jumped() const;

  std::optional<timing::GnssClock> clock() const { return clock_; }
  std::optional<UtcTime> last_fix() const { return last_fix_; }
  std::optional<geodesy::LocalFrame> frame() const { return frame_; }

 private:
  GnssFix dated(const GnssFix& fix, HostTime first_byte) const;
  void refit();
  std::optional<Motion> foreseen_at(GpsTime epoch) const;
  void follow_jumps(const std::optional<Motion>& foreseen);
  void follow_height(GpsTime epoch, const GnssFix& fix);
  std::optional<Motion> known_at(HostTime time) const;

  NavigatorOptions options_;
  std::optional<nanoseconds> wall_minus_host_;
  timing::ClockFit arrivals_;
  timing::PpsFit pulses_;
  std::optional<timing::GnssClock> clock_;
  timing::AntennaPredictor predictor_;
  std::optional<geodesy::LocalFrame> frame_;
  std::optional<UtcTime> last_fix_;
  timing::HeightFilter heights_;  // ahead of the newest fix it is better than the predictor
  std::optional<GpsTime> newest_;
  FixQuality newest_quality_ = FixQuality::kNone;
  std::uint64_t restarts_ = 0;    // of the predictor
  double stated_m2_ = 0;          // variance of a height, as the newest fix has it
  std::optional<Motion> last_;    // at the last usable fix
  std::uint64_t begun_anew_ = 0;  // of the predictor's restarts, looked at
  Eigen::Vector3d jumped_m_ = Eigen::Vector3d::Zero();  // the sum of all jumps
};

}  // namespace plumbline::capture
