// SPDX-License-Identifier: MIT
#include "sim/replay_camera.h"

#include <algorithm>
#include <utility>

namespace plumbline::sim {

struct ReplayCamera::Running {
  CameraLink link;
  std::optional<std::uint64_t> last_sequence;
};

ReplayCamera::ReplayCamera(VirtualClock& clock, Recording recording)
    : clock_(clock), recording_(std::move(recording)) {}

ReplayCamera::~ReplayCamera() { stop(); }

Status ReplayCamera::start(const CameraOptions& options, Sink sink) {
  if (running_) {
    return Error{"Camera '" + recording_.name +
                 "' is already running; stop it before starting it anew."};
  }
  if (auto other = other_mode_than(options, PixelFormat::kMjpeg, recording_.width_px,
                                   recording_.height_px)) {
    return *other;
  }
  running_ = std::make_shared<Running>(Running{CameraLink(std::move(sink), 5), std::nullopt});
  at(clock_.now(), [this] {
    running_->link.report(clock_.now(), CameraState::kStarting, "The recording begins.");
  });
  std::size_t first = 0;
  while (first < recording_.frames.size() && delivery_of(recording_.frames[first]) < clock_.now()) {
    ++first;
  }
  schedule(first);
  return Done{};
}

void ReplayCamera::stop() { running_.reset(); }

void ReplayCamera::limit_exposure(std::chrono::microseconds) {
  if (!running_) return;
  at(clock_.now(),
     [this] { running_->link.notice(clock_.now(), "A recording's exposure cannot be changed."); });
}

Result<CameraDescription> ReplayCamera::describe() {
  return CameraDescription{
      recording_.name,
      "recording",
      "replay",
      {{recording_.width_px, recording_.height_px, PixelFormat::kMjpeg, std::nullopt}},
      {}};
}

HostTime ReplayCamera::delivery_of(const RecordedFrame& recorded) const {
  const ExposureTiming& timing = recorded.frame.timing;
  return timing.first_row_start + timing.exposure +
         std::max(recording_.height_px - 1, 0) * timing.row_time + recording_.delivery;
}

void ReplayCamera::schedule(std::size_t index) {
  if (index < recording_.frames.size()) {
    at(delivery_of(recording_.frames[index]), [this, index] { deliver(index); });
    return;
  }
  at(clock_.now(), [this] {
    running_->link.report(clock_.now(), CameraState::kAbsent, "The recording has ended.");
  });
}

void ReplayCamera::deliver(std::size_t index) {
  const RecordedFrame& recorded = recording_.frames[index];
  const std::uint64_t sequence = recorded.frame.sequence;
  const std::uint64_t expected = running_->last_sequence.value_or(sequence - 1) + 1;
  for (std::uint64_t lost = expected; lost < sequence; ++lost) running_->link.lose();
  running_->last_sequence = sequence;
  schedule(index + 1);
  Result<std::vector<std::uint8_t>> jpeg = recorded.jpeg();
  if (!jpeg) {
    running_->link.lose();
    running_->link.notice(clock_.now(), jpeg.error().sentence);
    return;
  }
  const std::shared_ptr<Running> running = running_;  // the sink may stop the camera
  running->link.deliver(
      clock_.now(), recorded.frame,
      {PixelFormat::kMjpeg, recording_.width_px, recording_.height_px, std::move(jpeg).value()});
}

void ReplayCamera::at(HostTime time, std::function<void()> action) {
  clock_.at(time, [running = std::weak_ptr<Running>(running_), action = std::move(action)] {
    if (!running.expired()) action();
  });
}

}  // namespace plumbline::sim
