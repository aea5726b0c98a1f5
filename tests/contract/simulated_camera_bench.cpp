// SPDX-License-Identifier: MIT
#include "tests/contract/simulated_camera_bench.h"

#include <utility>

#include "edge/jpeg/jpeg.h"
#include "sim/replay_camera.h"
#include "sim/sim_camera.h"
#include "sim/virtual_clock.h"

namespace plumbline::contract {
namespace {

using std::chrono::milliseconds;

// A camera that the test may destroy while the bench keeps its hand on the device.
class Lease : public Camera {
 public:
  explicit Lease(std::shared_ptr<Camera> camera) : camera_(std::move(camera)) {}
  ~Lease() override { camera_->stop(); }
  Status start(const CameraOptions& options, Sink sink) override {
    return camera_->start(options, std::move(sink));
  }
  void stop() override { camera_->stop(); }
  void limit_exposure(std::chrono::microseconds longest) override {
    camera_->limit_exposure(longest);
  }
  Result<CameraDescription> describe() override { return camera_->describe(); }

 private:
  std::shared_ptr<Camera> camera_;
};

class VirtualBench : public CameraBench {
 public:
  CameraOptions options() override { return {}; }
  HostTime now() override { return clock_.now(); }
  void pass(std::chrono::nanoseconds time) override { clock_.run_until(clock_.now() + time); }
  std::unique_ptr<Camera> missing_camera() override { return nullptr; }
  bool inflict(CameraFault) override { return false; }
  void mend() override {}
  bool unplug() override { return false; }
  void plug_in() override {}

 protected:
  sim::VirtualClock clock_{HostTime(std::chrono::seconds(100))};
};

sim::SimCameraOptions with_jitter() {
  sim::SimCameraOptions options;
  options.sigma_interval = milliseconds(2);
  options.sigma_stamp = milliseconds(1);
  return options;
}

class SimulatedBench : public VirtualBench {
 public:
  SimulatedBench()
      : device_(std::make_shared<sim::SimCamera>(clock_, with_jitter())),
        missing_(std::make_shared<sim::SimCamera>(clock_, with_jitter())) {
    missing_->unplug();
  }

  std::unique_ptr<Camera> camera() override { return std::make_unique<Lease>(device_); }
  std::unique_ptr<Camera> missing_camera() override { return std::make_unique<Lease>(missing_); }

  bool inflict(CameraFault fault) override {
    if (fault == CameraFault::kSilence) device_->silence(true);
    if (fault == CameraFault::kDrop) device_->drop(0.3);
    if (fault == CameraFault::kBrokenStream) device_->break_stream();
    return true;
  }
  void mend() override {
    device_->silence(false);
    device_->drop(0);
  }
  bool unplug() override {
    device_->unplug();
    return true;
  }
  void plug_in() override { device_->plug_in(); }

 private:
  std::shared_ptr<sim::SimCamera> device_;
  std::shared_ptr<sim::SimCamera> missing_;
};

// 20 s at 10 frames a second, of which every seventh was lost when it was recorded.
sim::Recording recording() {
  Image image{16, 12, 1, {}};
  image.data.assign(16 * 12, 99);
  const std::vector<std::uint8_t> jpeg = jpeg::encode(image, 90);
  sim::Recording recording{"flight", 16, 12, {}, milliseconds(30)};
  for (int i = 0; i < 200; ++i) {
    if (i % 7 == 6) continue;
    sim::RecordedFrame recorded;
    recorded.frame.sequence = static_cast<std::uint64_t>(i);
    recorded.frame.timing = {HostTime(milliseconds(100100 + 100 * i)), milliseconds(2),
                             std::chrono::microseconds(20), milliseconds(1)};
    recorded.jpeg = [jpeg] { return jpeg; };
    recording.frames.push_back(std::move(recorded));
  }
  return recording;
}

class ReplayedBench : public VirtualBench {
 public:
  std::unique_ptr<Camera> camera() override {
    return std::make_unique<sim::ReplayCamera>(clock_, recording());
  }
  bool inflict(CameraFault fault) override { return fault == CameraFault::kDrop; }
};

}  // namespace

std::unique_ptr<CameraBench> make_simulated_camera_bench() {
  return std::make_unique<SimulatedBench>();
}

std::unique_ptr<CameraBench> make_replayed_camera_bench() {
  return std::make_unique<ReplayedBench>();
}

}  // namespace plumbline::contract
