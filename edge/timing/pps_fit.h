// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <optional>

#include "edge/base/time.h"
#include "edge/timing/gnss_clock.h"

namespace plumbline::timing {

struct PpsFitOptions {
  std::size_t pulses = 24;  // the line is fitted to so many, which a crystal's bend allows
  std::chrono::seconds longest_window{120};
  double rate_limit = 200e-6;
  double rate_walk_per_sqrt_s = 0.02e-6;
  double rate_change_per_s = 0.03e-6;  // warming: 2 ppm per minute, 1 sigma
  // From the pulse to the kernel's stamp at the quickest, and its sigma; both are common to the
  // flight. As a rule it is later: a delay that scatters is at least about as long as it scatters,
  // so the scatter is added to both.
  nanoseconds interrupt = std::chrono::microseconds(3);
  nanoseconds interrupt_sigma = std::chrono::microseconds(3);
  nanoseconds least_scatter = std::chrono::microseconds(1);
  nanoseconds gate = std::chrono::microseconds(100);  // further off is no pulse of this train
  int confirming = 5;                                 // pulses that agree, to begin or begin anew
  nanoseconds least_latency = std::chrono::milliseconds(-5);  // what a receiver's can be
  nanoseconds most_latency = std::chrono::milliseconds(450);
};

enum class PpsState {
  kNoPulses,    // or too few that agree
  kUnnumbered,  // they agree; no epochs yet to tell which second is which
  kWrongEdge,   // epochs would arrive before the second they are for, or too late: the other edge
                // of the pulse is stamped, or it is no pulse per second
  kLocked
};

struct PpsFitSummary {
  std::uint64_t edges = 0;     // given
  std::uint64_t used = 0;      // pulses of the train
  std::uint64_t rejected = 0;  // other edges, doubled, late
  std::uint64_t restarts = 0;  // the train went on elsewhere
  nanoseconds scatter{};       // 1 sigma of a stamp about the line
};

// Host clock to GNSS time from stamps of a pulse per second. Robust: the train is the set of edges
// whose distances are whole seconds within `gate` and the drift; a line through the last of them is
// fitted by Tukey's biweight. Which second each is comes from epochs (clock_fit.h): their clock,
// whose latency is only assumed, must be right to a third of a second. One thread; deterministic.
class PpsFit {
 public:
  explicit PpsFit(const PpsFitOptions& options = {});

  // An edge of the kind that marks the second, stamped on the host clock, in order of time.
  void add_edge(HostTime stamp);

  // The clock, numbered with the help of `coarse`, which has sigma_latency of an assumption; then
  // its own common sigma is that of the interrupt. Empty unless state() is kLocked.
  std::optional<GnssClock> estimate(const std::optional<GnssClock>& coarse) const;
  PpsState state(const std::optional<GnssClock>& coarse) const;

  // The receiver's least latency as measured against the pulses. Empty unless there are pulses that
  // agree and a coarse clock.
  std::optional<nanoseconds> measured_latency(const std::optional<GnssClock>& coarse) const;

  const PpsFitSummary& summary() const { return summary_; }

 private:
  struct Line {
    HostTime last;  // when the newest pulse came, by the line
    double rate = 0;
    double variance_s2 = 0;
    double covariance_s = 0;
    double rate_variance = 0;
  };

  nanoseconds delay() const { return options_.interrupt + summary_.scatter; }
  bool belongs(HostTime stamp) const;
  void begin();
  void refit();

  PpsFitOptions options_;
  PpsFitSummary summary_;
  std::deque<HostTime> train_;
  std::deque<HostTime> strays_;  // of late, not of the train
  std::optional<Line> line_;
};

}  // namespace plumbline::timing
