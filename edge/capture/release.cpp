// SPDX-License-Identifier: MIT
#include "edge/capture/release.h"

#include <algorithm>
#include <chrono>
#include <cmath>

namespace plumbline::capture {
namespace {

constexpr nanoseconds kNoFrame = std::chrono::seconds(1);  // after the instant: none is coming
constexpr double kDelaySigma_s = 0.08;                     // before anything was seen
constexpr double kJitter_s = 0.005;                        // of one delay, if nothing else is known
constexpr int kRemembered = 12;  // exposures: a delay that drifts is followed

Exposure exposure_of(const FrameSeen& frame) {
  return {frame.timing.middle_of_row((frame.rows - 1) / 2.0), frame.timing.sigma, frame.sequence};
}

}  // namespace

void FrameRelease::see(const FrameSeen& frame) {
  const Exposure exposure = exposure_of(frame);
  const nanoseconds period = last_middle_ ? exposure.middle - *last_middle_ : nanoseconds{};
  last_middle_ = exposure.middle;
  ring_.push({exposure.middle, period}, exposure);
}

void FrameRelease::aim(HostTime instant) {
  wanted_ = instant;
  ring_.want(instant);
}

void FrameRelease::forget() {
  wanted_.reset();
  ring_.forget();
}

void FrameRelease::camera_left() {
  last_middle_.reset();
  ring_.clear();
  if (wanted_) ring_.want(*wanted_);
}

std::optional<Exposure> FrameRelease::take(HostTime now) {
  if (!wanted_) return std::nullopt;
  const auto taken = ring_.take(now);
  if (!taken) return std::nullopt;
  wanted_.reset();
  return taken->second;
}

bool FrameRelease::is_missed(HostTime now) const { return wanted_ && now >= *wanted_ + kNoFrame; }

HostTime FrameRelease::due() const { return wanted_ ? *wanted_ + kNoFrame : HostTime::max(); }

bool FrameRelease::holds(std::uint64_t sequence) const {
  return ring_.holds_if([&](const Exposure& held) { return held.frame == sequence; });
}

nanoseconds PulseRelease::delay() const {
  if (seen_ == 0) return options_.delay;
  return std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(mean_s_));
}

nanoseconds PulseRelease::delay_sigma() const {
  double sigma_s = kDelaySigma_s;
  if (seen_ == 1) sigma_s = 2 * kJitter_s;
  if (seen_ > 1) sigma_s = std::max(std::sqrt(squares_s2_ / (seen_ - 1)), kJitter_s);
  return std::chrono::duration_cast<nanoseconds>(std::chrono::duration<double>(sigma_s));
}

std::optional<Exposure> PulseRelease::see(const FrameSeen& frame) {
  return exposed(exposure_of(frame));
}

std::optional<Exposure> PulseRelease::see(const ShutterOpened& opened) {
  return exposed({opened.edge, std::chrono::microseconds(500), std::nullopt});
}

std::optional<Exposure> PulseRelease::assumed(HostTime now) {
  if (options_.is_answered || !pulsed_ || now < *pulsed_ + delay()) return std::nullopt;
  const HostTime pulsed = *pulsed_;
  pulsed_.reset();
  return Exposure{pulsed + delay(), delay_sigma(), std::nullopt};
}

std::optional<Exposure> PulseRelease::exposed(const Exposure& exposure) {
  if (!pulsed_) return std::nullopt;
  const nanoseconds delay = exposure.middle - *pulsed_;
  if (delay < nanoseconds{} || delay > options_.longest_delay) return std::nullopt;
  pulsed_.reset();
  const double delay_s = std::chrono::duration<double>(delay).count();
  seen_ = std::min(seen_ + 1, kRemembered);
  const double off_s = delay_s - mean_s_;
  mean_s_ += off_s / seen_;
  squares_s2_ += off_s * (delay_s - mean_s_);
  if (seen_ == 1) squares_s2_ = 0;
  if (seen_ == kRemembered) squares_s2_ *= 1 - 1.0 / kRemembered;
  return exposure;
}

HostTime PulseRelease::due() const {
  if (!pulsed_) return HostTime::max();
  return *pulsed_ + (options_.is_answered ? options_.longest_delay : delay());
}

}  // namespace plumbline::capture
