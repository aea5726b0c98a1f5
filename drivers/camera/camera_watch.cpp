// SPDX-License-Identifier: MIT
#include "drivers/camera/camera_watch.h"

#include <algorithm>
#include <utility>

namespace plumbline {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr milliseconds kFirstRetry{50};
constexpr milliseconds kLongestRetry{1000};
constexpr seconds kLongestSilence{3};  // of a camera that has streamed
constexpr seconds kLongestStart{8};    // sensors and pipelines may take seconds to begin

}  // namespace

std::optional<CameraReport> CameraWatch::starting(HostTime now, std::chrono::nanoseconds period) {
  period_ = period;
  last_sign_ = now;
  got_frame_ = false;
  damaged_ = 0;
  if (reported_ && *reported_ != CameraState::kAbsent) return std::nullopt;
  return change(now, CameraState::kStarting, "Camera " + name_ + " is starting.");
}

std::optional<CameraReport> CameraWatch::frame(HostTime now) {
  last_sign_ = now;
  got_frame_ = true;
  damaged_ = 0;
  retry_ = milliseconds(0);
  return change(now, CameraState::kStreaming, "Camera " + name_ + " delivers frames.");
}

std::optional<CameraReport> CameraWatch::tick(HostTime now) {
  if (now < stall_deadline()) return std::nullopt;
  if (damaged_ > 0) {
    return failed(now, CameraState::kFailing,
                  "Camera " + name_ + " delivers damaged frames only; check its cable.");
  }
  if (reported_ == CameraState::kAbsent || reported_ == CameraState::kFailing) return std::nullopt;
  return change(now, CameraState::kStalled,
                "Camera " + name_ +
                    " has stopped delivering frames; it is started anew if that goes on. Check "
                    "its cable and power.");
}

std::optional<CameraReport> CameraWatch::failed(HostTime now, CameraState state,
                                                const std::string& sentence) {
  return change(now, state, sentence);
}

HostTime CameraWatch::stall_deadline() const {
  return last_sign_ + std::max<std::chrono::nanoseconds>(2 * period_, seconds(1));
}

bool CameraWatch::is_lost(HostTime now) const {
  const std::chrono::nanoseconds longest = got_frame_ ? kLongestSilence : kLongestStart;
  return now - last_sign_ > std::max(longest, 4 * period_);
}

milliseconds CameraWatch::next_retry() {
  retry_ = retry_ == milliseconds(0) ? kFirstRetry : std::min(2 * retry_, kLongestRetry);
  return retry_;
}

std::optional<CameraReport> CameraWatch::change(HostTime now, CameraState state,
                                                std::string sentence) {
  state_ = state;
  if (reported_ == state) return std::nullopt;
  reported_ = state;
  return CameraReport{now, state, std::move(sentence)};
}

}  // namespace plumbline
