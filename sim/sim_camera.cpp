// SPDX-License-Identifier: MIT
#include "sim/sim_camera.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::sim {

using std::chrono::nanoseconds;

struct SimCamera::Running {
  CameraLink link;
  nanoseconds exposure;
  HostTime next_start;                 // of the next exposure, without its jitter
  HostTime last_sign;                  // of a frame that got through
  std::optional<HostTime> deaf_until;  // while it is opened anew
  std::uint64_t exposed = 0;
};

SimCamera::SimCamera(VirtualClock& clock, SimCameraOptions options)
    : clock_(clock),
      options_(std::move(options)),
      period_(std::llround(1e9 / options_.frames_per_s)),
      random_(options_.seed) {}

SimCamera::~SimCamera() { stop(); }

Status SimCamera::start(const CameraOptions& options, Sink sink) {
  if (running_) {
    return Error{"Camera '" + options_.id +
                 "' is already running; stop it before starting it anew."};
  }
  const PixelFormat format = options_.channels == 3 ? PixelFormat::kRgb24 : PixelFormat::kGrey;
  if (auto other = other_mode_than(options, format, options_.width_px, options_.height_px)) {
    return *other;
  }
  const HostTime now = clock_.now();
  running_ = std::make_shared<Running>(Running{CameraLink(std::move(sink), options_.buffers),
                                               options.longest_exposure, now + period_, now,
                                               std::nullopt, 0});
  at(now, [this] { begin(); });
  if (!options_.released) schedule_frame();
  return Done{};
}

void SimCamera::begin() {
  CameraLink& link = running_->link;
  if (!plugged_) {
    link.report(clock_.now(), CameraState::kAbsent, "There is no camera; plug it in.");
  } else if (options_.released) {
    link.report(clock_.now(), CameraState::kStreaming, "The camera waits for its release.");
  } else {
    link.report(clock_.now(), CameraState::kStarting, "The camera is starting.");
  }
  if (!options_.released) watch_for_silence();  // silence is its rule where it is released
}

void SimCamera::release(HostTime first_row_start) {
  if (!running_) return;
  at(first_row_start, [this, first_row_start] { expose(first_row_start); });
}

void SimCamera::stop() { running_.reset(); }

void SimCamera::limit_exposure(std::chrono::microseconds longest) {
  if (running_) running_->exposure = longest;
}

Result<CameraDescription> SimCamera::describe() {
  if (!plugged_) return Error{"There is no camera '" + options_.id + "'; plug it in."};
  const PixelFormat format = options_.channels == 3 ? PixelFormat::kRgb24 : PixelFormat::kGrey;
  return CameraDescription{options_.id,
                           "simulated camera",
                           "sim",
                           {{options_.width_px, options_.height_px, format, options_.frames_per_s}},
                           {}};
}

void SimCamera::silence(bool on) { silent_ = on; }

void SimCamera::break_stream() {
  if (!running_) return;
  running_->deaf_until = clock_.now() + 2 * period_;
  at(clock_.now(), [this] {
    running_->link.report(clock_.now(), CameraState::kFailing,
                          "The camera failed while streaming (Input/output error). It is opened "
                          "anew.");
  });
}

void SimCamera::unplug() {
  plugged_ = false;
  if (!running_) return;
  at(clock_.now(), [this] {
    running_->link.report(clock_.now(), CameraState::kAbsent,
                          "The camera was unplugged; plug it in again.");
  });
}

void SimCamera::plug_in() {
  plugged_ = true;
  if (running_) running_->deaf_until = clock_.now() + period_;
}

bool SimCamera::sees() const {
  const bool deaf = running_->deaf_until && clock_.now() < *running_->deaf_until;
  return plugged_ && !silent_ && !deaf;
}

void SimCamera::schedule_frame() {
  const HostTime start = running_->next_start + gaussian(options_.sigma_interval);
  running_->next_start += period_;
  at(std::max(start, clock_.now()), [this] {
    expose(clock_.now());
    schedule_frame();
  });
}

void SimCamera::expose(HostTime first_row_start) {
  const ExposureTiming exact{first_row_start, running_->exposure, options_.row_time, {}};
  const bool lost =
      !sees() || std::uniform_real_distribution<double>(0, 1)(random_) < options_.drop_probability;
  if (lost) {
    running_->link.lose();
  } else {
    const HostTime readout_ends =
        exact.first_row_start + exact.exposure + (options_.height_px - 1) * options_.row_time;
    at(readout_ends + options_.delivery, [this, exact] { deliver(exact); });
  }
}

void SimCamera::deliver(const ExposureTiming& exact) {
  if (!sees()) {
    running_->link.lose();
    return;
  }
  running_->last_sign = clock_.now();
  Frame frame;
  frame.timing = stated(exact);
  frame.gain = 1.0;
  const std::shared_ptr<Running> running = running_;  // the sink may stop the camera
  running->link.deliver(clock_.now(), std::move(frame), picture_of(exact));
}

// One check outstanding at any time, at the moment when silence would be a stall.
void SimCamera::watch_for_silence() {
  const nanoseconds limit = std::max<nanoseconds>(2 * period_, std::chrono::seconds(1));
  const HostTime now = clock_.now();
  const bool reported = running_->link.state() == CameraState::kAbsent ||
                        running_->link.state() == CameraState::kFailing;
  if (now - running_->last_sign >= limit && !reported && running_->link.has_free_buffer()) {
    running_->link.report(now, CameraState::kStalled,
                          "The camera has stopped delivering frames; check its cable and power.");
  }
  const HostTime next = running_->last_sign + limit;
  at(next > now ? next : now + period_, [this] { watch_for_silence(); });
}

ExposureTiming SimCamera::stated(const ExposureTiming& exact) {
  ExposureTiming timing = exact;
  timing.first_row_start += gaussian(options_.sigma_stamp);
  timing.sigma = std::max(options_.sigma_stamp, nanoseconds(1));
  return timing;
}

FramePixels SimCamera::picture_of(const ExposureTiming& exact) {
  FramePixels picture;
  picture.format = options_.channels == 3 ? PixelFormat::kRgb24 : PixelFormat::kGrey;
  picture.width_px = options_.width_px;
  picture.height_px = options_.height_px;
  const std::uint64_t number = running_->exposed++;
  if (options_.picture) {
    picture.bytes = options_.picture(exact).data;
  } else {
    picture.bytes.assign(
        row_bytes(picture.format, picture.width_px) * static_cast<std::size_t>(picture.height_px),
        static_cast<std::uint8_t>(number));
  }
  return picture;
}

// An action of this start(): stopped or destroyed before its time, the camera does nothing.
void SimCamera::at(HostTime time, std::function<void()> action) {
  clock_.at(time, [running = std::weak_ptr<Running>(running_), action = std::move(action)] {
    if (!running.expired()) action();
  });
}

nanoseconds SimCamera::gaussian(nanoseconds sigma) {
  if (sigma == nanoseconds(0)) return nanoseconds(0);
  std::normal_distribution<double> error(0, static_cast<double>(sigma.count()));
  return nanoseconds(std::llround(error(random_)));
}

}  // namespace plumbline::sim
