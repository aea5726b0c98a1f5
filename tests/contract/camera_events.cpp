// SPDX-License-Identifier: MIT
#include <utility>

#include "tests/contract/camera_contract.h"

namespace plumbline::contract {

void CameraEvents::hold(std::size_t most) {
  const std::lock_guard lock(mutex_);
  most_held_ = most;
}

std::vector<Frame> CameraEvents::release() {
  const std::lock_guard lock(mutex_);
  most_held_ = 0;
  std::vector<Frame> frames;
  for (std::shared_ptr<const RawImage>& image : held_) {
    Frame frame;
    frame.image = std::move(image);
    frames.push_back(std::move(frame));
  }
  held_.clear();
  return frames;
}

void CameraEvents::check(const Frame& frame) {
  damaged_ = damaged_ || !frame.image || !check_layout(*frame.image).ok();
  const std::uint64_t lost = std::exchange(lost_since_frame_, 0);
  if (frames_.empty()) return;
  const Frame& last = frames_.back();
  const bool counted = frame.sequence == last.sequence + lost + 1;
  const bool forward = frame.timing.middle_of_row(0) > last.timing.middle_of_row(0);
  if (counted && forward) return;
  const auto step = frame.timing.middle_of_row(0) - last.timing.middle_of_row(0);
  disorder_ += "frame " + std::to_string(frame.sequence) + " after " +
               std::to_string(last.sequence) + " with " + std::to_string(lost) + " lost, " +
               std::to_string(step.count()) + " ns later (sigma " +
               std::to_string(frame.timing.sigma.count()) + " after " +
               std::to_string(last.timing.sigma.count()) + " ns); ";
}

void CameraEvents::add(CameraEvent event) {
  const std::lock_guard lock(mutex_);
  ++count_;
  if (auto* frame = std::get_if<Frame>(&event)) {
    check(*frame);
    if (held_.size() < most_held_) held_.push_back(frame->image);
    frame->image.reset();
    frames_.push_back(std::move(*frame));
  } else if (const auto* gap = std::get_if<FramesLost>(&event)) {
    lost_ += gap->count;
    lost_since_frame_ += gap->count;
  } else if (const auto* report = std::get_if<CameraReport>(&event)) {
    reports_.push_back(*report);
  } else if (const auto* notice = std::get_if<CameraNotice>(&event)) {
    notices_.push_back(*notice);
  }
}

std::vector<Frame> CameraEvents::frames() const {
  const std::lock_guard lock(mutex_);
  return frames_;
}

std::uint64_t CameraEvents::lost() const {
  const std::lock_guard lock(mutex_);
  return lost_;
}

std::vector<CameraReport> CameraEvents::reports() const {
  const std::lock_guard lock(mutex_);
  return reports_;
}

std::vector<CameraNotice> CameraEvents::notices() const {
  const std::lock_guard lock(mutex_);
  return notices_;
}

std::size_t CameraEvents::count() const {
  const std::lock_guard lock(mutex_);
  return count_;
}

bool CameraEvents::damaged() const {
  const std::lock_guard lock(mutex_);
  return damaged_;
}

std::string CameraEvents::disorder() const {
  const std::lock_guard lock(mutex_);
  return disorder_;
}

}  // namespace plumbline::contract
