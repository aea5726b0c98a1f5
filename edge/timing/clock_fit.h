// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <vector>

#include "edge/base/ring.h"
#include "edge/base/time.h"
#include "edge/timing/envelope.h"
#include "edge/timing/gnss_clock.h"

namespace plumbline::timing {

struct ClockFitOptions {
  Latency latency;
  // Arrivals of the last `window`; older ones, up to `longest_window`, only where there are gaps.
  std::chrono::seconds window{240};
  std::chrono::seconds longest_window{1800};
  // The earliest arrival of each such piece of the window is kept: memory is bounded whatever the
  // rate.
  std::chrono::seconds piece{2};
  // What a computer's crystal does: its rate, 1 sigma, and how it wanders (temperature).
  double rate_sigma = 50e-6;
  double rate_walk_per_sqrt_s = 0.02e-6;
  // And how fast it may go one way for minutes, 1 sigma: a board that warms or cools at 0.1 degree
  // per second, at a third of a ppm per degree.
  double rate_ramp_per_s = 0.03e-6;
  // What brings the bytes brings them at such steps: USB's frames; the latency timer of an FTDI
  // adapter that was not asked for low latency makes it 16 ms.
  nanoseconds poll = std::chrono::milliseconds(1);
  // An epoch that is further off than this is late (after) or impossible (before); if all of
  // `confirming` are so, over `late_lasts` where they are late, the receiver's time has stepped.
  nanoseconds step = std::chrono::milliseconds(150);
  int confirming = 3;
  std::chrono::seconds late_lasts{10};
  // Time stamps off this grid were rounded (NMEA writes 10 ms): up to half of `rounding` is
  // unknown.
  nanoseconds exact_grid = std::chrono::milliseconds(50);
  nanoseconds rounding = std::chrono::milliseconds(10);
};

struct ClockFitSummary {
  std::uint64_t epochs = 0;    // given
  std::uint64_t used = 0;      // among those the envelope is looked for
  std::uint64_t repeated = 0;  // the same epoch as one just before: left out
  std::uint64_t late = 0;      // more than a step behind the envelope: left out
  std::uint64_t early = 0;     // more than a step ahead of it, and not confirmed: left out
  std::uint64_t steps = 0;     // of the receiver's time, or of the host's (a sleep)
  nanoseconds last_step{};     // what was added to host minus GNSS time
  bool in_doubt = false;       // the last epochs do not fit: perhaps a step, not yet confirmed
};

// Host clock to GNSS time from when epochs arrive. An arrival is the epoch plus a latency that has
// a floor and a tail (positioning, burst, polling, scheduling), so the line below all arrivals of a
// window is what the clocks do, plus the least latency, which is a given with a sigma. The idea of
// a line under the delays: Moon, Skelly and Towsley 1999, "Estimation and removal of clock skew
// from network delay measurements"; how it is found, and its sigma: envelope.h. Deterministic;
// one thread.
class ClockFit {
 public:
  explicit ClockFit(const ClockFitOptions& options = {});

  // `first_byte`: arrival of the first byte of the epoch, in order of arrival. True when with this
  // epoch a step has been confirmed (see summary()): the fit has begun anew after it.
  bool add(GpsTime epoch, HostTime first_byte);

  // Empty before the first epochs; valid about the last epoch, with a sigma that grows after it.
  std::optional<GnssClock> estimate() const;

  const ClockFitSummary& summary() const { return summary_; }

 private:
  struct Arrival {
    GpsTime epoch;
    HostTime host;
    nanoseconds delay() const { return host.time_since_epoch() - epoch.time_since_epoch(); }
  };

  nanoseconds behind(const Arrival& arrival) const;
  nanoseconds tolerance(const Arrival& arrival) const;
  void use(const Arrival& arrival);
  void forget_old();
  bool doubt(const Arrival& arrival, bool late);
  bool confirmed() const;
  void begin_anew();
  void refit();
  void allow_for_poll(GnssClock& clock) const;
  void allow_for_rounding(GnssClock& clock) const;

  ClockFitOptions options_;
  ClockFitSummary summary_;
  Ring<Arrival> earliest_;          // one per piece of the window, oldest first
  std::vector<Arrival> doubtful_;   // the last ones, all late or all early
  std::vector<DelayPoint> points_;  // those of refit(), kept for their memory
  EnvelopeFinder finder_;
  bool doubtful_are_late_ = false;
  std::uint64_t used_since_start_ = 0;
  GpsTime newest_;
  std::optional<GpsTime> last_rounded_;
  std::optional<GnssClock> clock_;  // without the latency
};

}  // namespace plumbline::timing
