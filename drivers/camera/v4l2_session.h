// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera/exposure_model.h"
#include "drivers/camera/v4l2_buffers.h"
#include "drivers/camera/v4l2_device.h"

namespace plumbline {

// Why a camera could not be brought to stream.
struct V4l2Failure {
  CameraState state = CameraState::kFailing;  // kAbsent: not there
  bool waiting_helps = true;                  // as opposed to: no right, no camera, no such mode
  std::string sentence;
};

// What must stay the same for the camera to be the same: else it is a new one.
struct CameraInterior {
  int width_px = 0;
  int height_px = 0;
  PixelFormat format = PixelFormat::kGrey;
  std::optional<std::int64_t> focus;
  std::optional<std::int64_t> zoom;
  friend bool operator==(const CameraInterior&, const CameraInterior&) = default;
};

// From one opening of the device to its closing. All members from one thread.
class V4l2Session {
 public:
  // Opens, sets the mode and all controls, and starts to stream. `focus` is where the lens stood in
  // the session before.
  static std::unique_ptr<V4l2Session> open(const std::string& path, const CameraOptions& options,
                                           std::optional<std::int64_t> focus, V4l2Failure& failure);
  ~V4l2Session();
  V4l2Session(const V4l2Session&) = delete;
  V4l2Session& operator=(const V4l2Session&) = delete;

  const V4l2Device& device() const { return device_; }
  const V4l2Identity& identity() const { return identity_; }
  const std::vector<std::string>& notices() const { return notices_; }
  const CameraInterior& interior() const { return interior_; }
  std::chrono::nanoseconds period() const { return period_; }
  V4l2Buffers& buffers() { return *buffers_; }

  // One frame that is ready. 0, EAGAIN where there is none, or errno.
  int dequeue(V4l2Slot& filled);

  // How the pixels of a buffer lie.
  const RawImage& layout() const { return layout_; }

  ExposureTiming timing_of(const V4l2Slot& filled, HostTime arrival) const;

  void limit_exposure(std::chrono::microseconds longest, HostTime now);

  // Reads what the device says has changed: true if the picture did, so that the session must be
  // opened anew. `lens_moved`: focus or zoom.
  bool picture_changed(bool& lens_moved);

 private:
  V4l2Session(const std::string& path, const CameraOptions& options)
      : device_(path), options_(options) {}

  std::optional<V4l2Failure> configure(std::optional<std::int64_t> focus);
  std::optional<V4l2Failure> set_mode();
  int set_format(const CameraMode& mode);
  void set_rate(const CameraMode& mode);
  void show_whole_sensor();
  void stand_upright();
  void apply(const ControlPlan& plan);
  void set_control(const ControlSetting& setting);
  void read_interior();
  void read_exposure(HostTime set_at);
  void subscribe();
  std::optional<V4l2Failure> stream();
  V4l2Failure failure(const std::string& what, int error) const;

  V4l2Device device_;
  CameraOptions options_;
  V4l2Identity identity_;
  std::vector<V4l2Control> controls_;
  std::vector<std::string> notices_;
  RawImage layout_;
  CameraInterior interior_;
  std::chrono::nanoseconds period_{std::chrono::milliseconds(33)};
  ExposureHistory exposures_;
  std::shared_ptr<V4l2Buffers> buffers_;
};

}  // namespace plumbline
