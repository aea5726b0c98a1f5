// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <optional>

#include "edge/base/time.h"
#include "edge/capture/capture_plan.h"
#include "edge/capture/frame_ring.h"
#include "edge/capture/inputs.h"

namespace plumbline::capture {

struct Exposure {
  HostTime middle;
  nanoseconds sigma{};
  std::optional<std::uint64_t> frame;
};

// Gets the exposure that is aimed at out of a camera that runs freely. Frames are known by their
// sequence here; whoever holds their pixels may let go of those that are not held. Pure.
class FrameRelease {
 public:
  explicit FrameRelease(std::size_t idle_frames = 2) : ring_(idle_frames) {}

  void see(const FrameSeen& frame);
  void aim(HostTime instant);
  void forget();       // the aim
  void camera_left();  // and the frames

  // The exposure, once there is none nearer to come.
  std::optional<Exposure> take(HostTime now);

  bool is_missed(HostTime now) const;  // no frame came in time
  HostTime due() const;                // when to look at the two again; max: with the next frame
  bool holds(std::uint64_t sequence) const;

 private:
  FrameRing<Exposure> ring_;
  std::optional<HostTime> last_middle_;
  std::optional<HostTime> wanted_;
};

// Gets it by a pulse, which the exposure follows by a delay that is nearly the same each time: it
// is learned from the exposures seen. Pure.
class PulseRelease {
 public:
  explicit PulseRelease(const ReleaseOptions& options) : options_(options) {}

  nanoseconds delay() const;
  nanoseconds delay_sigma() const;

  void pulsed(HostTime now) { pulsed_ = now; }
  bool is_waiting() const { return pulsed_.has_value(); }

  // Says whether this is the exposure of the pulse.
  std::optional<Exposure> see(const FrameSeen& frame);
  std::optional<Exposure> see(const ShutterOpened& opened);

  // Where nothing answers: the exposure as it must have been, once it is over.
  std::optional<Exposure> assumed(HostTime now);

  bool is_missed(HostTime now) const { return pulsed_ && now >= due(); }
  HostTime due() const;
  void give_up() { pulsed_.reset(); }
  int learned_from() const { return seen_; }

 private:
  std::optional<Exposure> exposed(const Exposure& exposure);

  ReleaseOptions options_;
  std::optional<HostTime> pulsed_;
  int seen_ = 0;
  double mean_s_ = 0;
  double squares_s2_ = 0;
};

}  // namespace plumbline::capture
