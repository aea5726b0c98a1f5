// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera/exposure_history.h"
#include "drivers/camera/libcamera_module/libcamera_settings.h"

namespace plumbline {

// The memory of a stream's buffers; lives as long as a frame is held.
class MappedBuffers {
 public:
  ~MappedBuffers();
  bool map(const libcamera::FrameBuffer& buffer);

  // All planes of a buffer, which must lie in one piece; empty where they do not.
  std::span<const std::uint8_t> bytes_of(const libcamera::FrameBuffer& buffer) const;

 private:
  struct Mapping {
    void* start = nullptr;
    std::size_t length = 0;
  };
  std::map<int, Mapping> of_fd_;
};

struct LibcameraFailure {
  CameraState state = CameraState::kFailing;
  bool waiting_helps = true;
  std::string sentence;
};

// From one acquiring of a camera to its release. One thread, except where libcamera calls back:
// `completed` and `disconnected` come from libcamera's own thread.
class LibcameraSession {
 public:
  struct Callbacks {
    std::function<void(libcamera::Request*)> completed;
    std::function<void()> disconnected;
  };

  static std::unique_ptr<LibcameraSession> open(std::shared_ptr<libcamera::Camera> camera,
                                                const CameraOptions& options,
                                                std::optional<double> lens_position,
                                                Callbacks callbacks, LibcameraFailure& failure);
  ~LibcameraSession();
  LibcameraSession(const LibcameraSession&) = delete;
  LibcameraSession& operator=(const LibcameraSession&) = delete;

  const RawImage& layout() const { return layout_; }
  int buffer_count() const { return static_cast<int>(requests_.size()); }
  const std::vector<std::string>& notices() const { return settings_.notices; }
  const ExposureHistory& exposures() const { return exposures_; }  // as set
  const std::shared_ptr<MappedBuffers>& memory() const { return memory_; }

  const libcamera::FrameBuffer* buffer_of(const libcamera::Request& request) const;

  // Lets the camera fill it again; with it go changed controls. False: the camera refuses.
  bool queue(libcamera::Request* request);

  void limit_exposure(std::chrono::microseconds longest, HostTime now);

 private:
  LibcameraSession(std::shared_ptr<libcamera::Camera> camera, const CameraOptions& options,
                   Callbacks callbacks);

  std::optional<LibcameraFailure> configure(std::optional<double> lens_position);
  std::optional<LibcameraFailure> choose(libcamera::CameraConfiguration& configuration);
  std::optional<LibcameraFailure> make_requests();
  std::optional<LibcameraFailure> start();
  void note_exposure(HostTime set_at);
  LibcameraFailure failure(const std::string& what, int result) const;
  void on_completed(libcamera::Request* request) { callbacks_.completed(request); }
  void on_disconnected() { callbacks_.disconnected(); }

  std::shared_ptr<libcamera::Camera> camera_;
  CameraOptions options_;
  Callbacks callbacks_;
  libcamera::Stream* stream_ = nullptr;
  RawImage layout_;
  LibcameraSettings settings_;
  ExposureHistory exposures_;
  std::optional<libcamera::ControlList> changed_;  // for the next request
  std::unique_ptr<libcamera::FrameBufferAllocator> allocator_;
  std::shared_ptr<MappedBuffers> memory_;
  std::vector<std::unique_ptr<libcamera::Request>> requests_;
  bool acquired_ = false;
  bool started_ = false;
};

}  // namespace plumbline
