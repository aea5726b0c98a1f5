// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>

#include "edge/base/gnss_fix.h"
#include "edge/base/ring.h"
#include "edge/base/time.h"
#include "edge/geodesy/local_frame.h"
#include "edge/timing/gnss_clock.h"
#include "edge/timing/motion_filter.h"

namespace plumbline::timing {

struct PredictorOptions {
  MotionOptions motion;
  // Of the variance that a receiver states, what is new with each epoch. The rest is nearly the
  // same error from epoch to epoch: no averaging takes it away.
  double white_share = 0.2;
  nanoseconds longest_gap = std::chrono::seconds(2);    // nothing is said in longer ones
  nanoseconds longest_ahead = std::chrono::seconds(2);  // of the newest epoch
  nanoseconds history = std::chrono::seconds(10);       // how far back at() reaches
  std::size_t most_epochs = 256;                        // kept, whatever the rate
  double gate_sigmas = 6;                               // a fix further off is left out,
  double turn_gate_sigmas = 3;  // unless a pilot at the stick may have got there,
  int confirming = 3;           // or so many in a row are
};

struct PredictedAntenna {
  GpsTime time;
  nanoseconds ahead{};  // of the newest epoch; negative: epochs before and after are known
  geodesy::Geodetic position;
  // East, north, up at the position. Without what the least latency leaves open.
  Eigen::Matrix3d covariance_enu_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d velocity_enu_m_s = Eigen::Vector3d::Zero();
  // By how much the position would be further along if the receiver's least latency were longer by
  // its sigma: one error, with its sign, common to the flight.
  Eigen::Vector3d latency_shift_enu_m = Eigen::Vector3d::Zero();
  FixQuality quality = FixQuality::kNone;
  bool sigma_assumed = false;  // the receiver stated none
};

struct PredictorSummary {
  std::uint64_t used = 0;
  std::uint64_t no_position = 0;  // or no date
  std::uint64_t repeated = 0;     // not newer than the epoch before
  std::uint64_t outliers = 0;     // left out
  std::uint64_t restarts = 0;     // after a gap, or where outliers agreed
};

// Where the antenna is at any instant of late: between epochs from those before and after, and
// foreseen from those before, as the trigger needs it. A Kalman filter of position, velocity and
// acceleration, smoothed where later epochs are known. A change of quality is a new common error:
// the position jumps with it, the velocity does not. Deterministic, bounded memory; one thread.
class AntennaPredictor {
 public:
  explicit AntennaPredictor(const PredictorOptions& options = {});

  // In order of arrival. True where the fix was used.
  bool add(const GnssFix& fix);

  // Empty before the first position, too far ahead or back, and in gaps.
  std::optional<PredictedAntenna> at(GpsTime time) const;

  // The same with what `clock` leaves open: its sigma times the velocity in the covariance, that of
  // the latency apart.
  std::optional<PredictedAntenna> at(HostTime time, const GnssClock& clock) const;

  const PredictorSummary& summary() const { return summary_; }

 private:
  struct Epoch {
    GpsTime time;
    MotionState foreseen;  // from the epochs before
    MotionState state;     // with this one
    Eigen::Matrix3d stated_m2 = Eigen::Matrix3d::Zero();
    FixQuality quality = FixQuality::kNone;
    bool sigma_assumed = false;
    bool begins = false;  // nothing before it is joined to it
  };
  struct Seen;

  std::optional<Seen> seen_in(const GnssFix& fix) const;
  void begin(const Seen& seen);
  bool go_on(const Seen& seen);
  bool refuse(const Seen& seen);
  void keep(Epoch epoch);
  std::optional<MotionState> motion_at(std::size_t before, GpsTime time) const;
  MotionState known_at(std::size_t index) const;

  PredictorOptions options_;
  PredictorSummary summary_;
  MotionFilter filter_;
  std::optional<geodesy::LocalFrame> frame_;  // about the first position
  Ring<Epoch> epochs_;                        // oldest first
  int outliers_in_a_row_ = 0;
};

}  // namespace plumbline::timing
