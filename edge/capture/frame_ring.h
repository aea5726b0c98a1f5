// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <deque>
#include <optional>
#include <utility>

#include "edge/base/time.h"

namespace plumbline::capture {

// When a frame was exposed, as far as choosing between frames needs it.
struct FrameTime {
  HostTime middle;                    // of its exposure, of the middle row
  std::chrono::nanoseconds period{};  // from the frame before it
};

// Whether a later frame may lie nearer to `wanted` than one of `middle`: the next one is expected
// a period after the last. With a free-running camera of period T the nearest frame is off by up to
// T/2, T/sqrt(12) RMS: at speed v the photo stands vT/sqrt(12) beside the wanted place.
bool may_improve(HostTime wanted, HostTime nearest_middle, HostTime last_middle,
                 std::chrono::nanoseconds period);

// How far a frame is from the instant that is wanted.
std::chrono::nanoseconds distance(HostTime a, HostTime b);

// Of the last frames that of which the middle of the exposure lies nearest to a wanted instant.
// Frames are lent buffers, of which a camera has few: without a wish the last `idle` are held, so
// that an instant just gone by can be had; with one, only the nearest yet. Two are enough for
// wishes no older than a period. Frame: movable. Pure; one thread.
template <typename Frame>
class FrameRing {
 public:
  explicit FrameRing(std::size_t idle) : idle_(std::max<std::size_t>(idle, 1)) {}

  // A frame as it comes, in order of exposure.
  void push(FrameTime time, Frame frame) {
    last_ = time;
    held_.push_back({time, std::move(frame)});
    drop_what_is_not_needed();
  }

  // Asks for the frame nearest to `instant`, which may be past or to come. The wish before, if it
  // was not fulfilled, is forgotten.
  void want(HostTime instant) {
    wanted_ = instant;
    drop_what_is_not_needed();
  }
  bool is_wanting() const { return wanted_.has_value(); }

  // The wanted frame, once no later one can lie nearer, or at `now` none has come for two periods
  // after the instant. Then the wish is fulfilled. Empty before, and when there is no frame at all.
  std::optional<std::pair<FrameTime, Frame>> take(HostTime now) {
    if (!wanted_ || held_.empty()) return std::nullopt;
    const bool in_time =
        may_improve(*wanted_, held_.front().first.middle, last_->middle, last_->period);
    const bool overdue =
        now > *wanted_ + 2 * last_->period && now > last_->middle + 3 * last_->period;
    if (in_time && !overdue) return std::nullopt;
    std::pair<FrameTime, Frame> nearest = std::move(held_.front());
    held_.pop_front();
    wanted_.reset();
    return nearest;
  }

  void forget() { wanted_.reset(); }  // the wish

  // Whether `is_it` holds for a frame that is held.
  template <typename Predicate>
  bool holds_if(Predicate is_it) const {
    return std::any_of(held_.begin(), held_.end(),
                       [&](const auto& held) { return is_it(held.second); });
  }

  // Lets go of all frames and the wish: the camera was stopped, or is another one now.
  void clear() {
    held_.clear();
    wanted_.reset();
    last_.reset();
  }

  std::size_t held() const { return held_.size(); }

 private:
  void drop_what_is_not_needed() {
    if (!wanted_) {
      while (held_.size() > idle_) held_.pop_front();
      return;
    }
    const auto nearest =
        std::min_element(held_.begin(), held_.end(), [this](const auto& a, const auto& b) {
          return distance(a.first.middle, *wanted_) < distance(b.first.middle, *wanted_);
        });
    if (nearest == held_.end()) return;
    std::pair<FrameTime, Frame> kept = std::move(*nearest);
    held_.clear();
    held_.push_back(std::move(kept));
  }

  std::size_t idle_;
  std::deque<std::pair<FrameTime, Frame>> held_;  // by time
  std::optional<FrameTime> last_;                 // that came
  std::optional<HostTime> wanted_;
};

}  // namespace plumbline::capture
