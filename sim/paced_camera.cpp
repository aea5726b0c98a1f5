// SPDX-License-Identifier: MIT
#include "sim/paced_camera.h"

#include <chrono>
#include <utility>

namespace plumbline::sim {
namespace {

constexpr std::chrono::milliseconds kBehind{300};  // then exposures that were due are lost

}  // namespace

PacedCamera::PacedCamera(Clock& clock, SimCameraOptions options)
    : clock_(clock),
      releases_(signal_),
      runs_freely_(!options.released),
      virtual_clock_(clock.now()),
      camera_(virtual_clock_, std::move(options)),
      thread_([this](const std::stop_token& stop) { live(stop); }) {}

PacedCamera::~PacedCamera() {
  thread_.request_stop();
  signal_.raise();
  thread_.join();
}

Status PacedCamera::start(const CameraOptions& options, Sink sink) {
  const std::lock_guard lock(mutex_);
  virtual_clock_.run_until(clock_.now());
  Status started = camera_.start(options, std::move(sink));
  signal_.raise();
  return started;
}

void PacedCamera::stop() {
  const std::lock_guard lock(mutex_);
  camera_.stop();
}

void PacedCamera::limit_exposure(std::chrono::microseconds longest) {
  const std::lock_guard lock(mutex_);
  camera_.limit_exposure(longest);
}

Result<CameraDescription> PacedCamera::describe() {
  const std::lock_guard lock(mutex_);
  return camera_.describe();
}

void PacedCamera::live(const std::stop_token& stop) {
  while (!stop.stop_requested()) clock_.wait(signal_, catch_up());
}

HostTime PacedCamera::catch_up() {
  const std::lock_guard lock(mutex_);
  while (const auto release = releases_.pop()) camera_.release(*release);
  const HostTime now = clock_.now();
  const bool is_behind = virtual_clock_.due() < now - kBehind;
  camera_.drop(runs_freely_ && is_behind ? 1 : 0);
  virtual_clock_.run_until(now);
  return virtual_clock_.due();
}

}  // namespace plumbline::sim
