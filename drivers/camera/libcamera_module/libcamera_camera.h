// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "drivers/camera.h"
#include "drivers/camera/camera_watch.h"
#include "drivers/camera/exposure_model.h"
#include "drivers/camera/frame_account.h"
#include "drivers/camera/libcamera_module/libcamera_session.h"
#include "drivers/clock.h"

namespace plumbline {

// libcamera's manager, of which a process may have one. Kept until the process ends.
libcamera::CameraManager& camera_manager();

// A camera behind libcamera, by libcamera's id. One thread of its own; libcamera's thread only
// hands it what completed.
class LibcameraCamera : public Camera {
 public:
  // `clock` outlives it, and is that by which the kernel stamps frames.
  LibcameraCamera(std::string id, const Clock& clock);
  ~LibcameraCamera() override;

  Status start(const CameraOptions& options, Sink sink) override;
  void stop() override;
  void limit_exposure(std::chrono::microseconds longest) override;
  Result<CameraDescription> describe() override;

 private:
  // What other threads hand to ours. Held by lent frames too, which may outlive the camera.
  struct Mailbox {
    std::mutex mutex;
    std::condition_variable changed;
    std::deque<libcamera::Request*> completed;
    std::deque<libcamera::Request*> given_back;
    std::uint64_t session = 0;  // counts them: what comes from an older one is dropped
    int lent = 0;               // of this session
    bool disconnected = false;
    bool stopping = false;
    std::optional<std::chrono::microseconds> new_limit;
  };

  void run();
  std::unique_ptr<LibcameraSession> open(LibcameraFailure& failure);
  LibcameraSession::Callbacks callbacks_of(std::uint64_t session);
  void adopt(std::unique_ptr<LibcameraSession> session);
  void stream();
  void close();
  void judge_silence(HostTime now);
  bool wait_until(HostTime deadline);
  bool take_letters();
  void requeue(libcamera::Request* request);
  void hand_out(libcamera::Request* request);
  std::shared_ptr<const RawImage> lend(libcamera::Request* request,
                                       std::span<const std::uint8_t> bytes);
  ExposureTiming timing_of(libcamera::Request& request, HostTime stamp);
  void learn_period(std::chrono::nanoseconds interval);
  void note_lens(const libcamera::ControlList& metadata);
  void fail(CameraState state, const std::string& sentence);
  void send(CameraEvent event) { sink_(std::move(event)); }
  void send(std::optional<CameraReport> report);

  const std::string id_;
  const Clock& clock_;
  CameraOptions options_;
  Sink sink_;
  std::thread thread_;
  std::shared_ptr<Mailbox> mailbox_;

  // Of the thread, while it runs.
  std::unique_ptr<LibcameraSession> session_;
  bool session_failed_ = false;
  std::optional<RawImage> mode_;  // of the session before
  std::optional<double> lens_position_;
  std::optional<HostTime> last_stamp_;
  unsigned last_sequence_ = 0;
  int intervals_ = 0;  // that the period was learnt from, up to a limit
  int interior_number_ = 0;
  std::vector<std::string> said_;
  CameraWatch watch_;
  FrameAccount account_;
};

}  // namespace plumbline
