// SPDX-License-Identifier: MIT
#include "firmware/service/camera_finder.h"

#include <utility>

namespace plumbline::service {

CameraFinder::CameraFinder(const CameraOptions& options, const Clock& clock, Cameras cameras,
                           Camera::Sink sink)
    : options_(options),
      clock_(clock),
      cameras_(std::move(cameras)),
      sink_(std::move(sink)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

CameraFinder::~CameraFinder() {
  thread_.request_stop();
  thread_.join();
  if (camera_) camera_->stop();
}

void CameraFinder::run(const std::stop_token& stop) {
  while (!stop.stop_requested() && !find()) std::this_thread::sleep_for(cameras_.every);
}

// Of several that fail the best one's reason counts.
bool CameraFinder::find() {
  const CamerasListed listed = cameras_.list();
  std::string trouble;
  for (const std::string& id : listed.ids) {
    const Status started = start(id);
    if (started && !trouble.empty()) {
      std::string why = "Took ";
      sink_(CameraNotice{clock_.now(), why.append(id).append(", for: ").append(trouble)});
    }
    if (started) return true;
    if (trouble.empty()) trouble = id + ": " + started.error().sentence;
  }
  if (!trouble.empty()) {
    tell(CameraState::kFailing, trouble);
    return false;
  }
  trouble = "No camera is found: connect one, and see plumbline camera.";
  // What is new may be over at the next look: udev gives the right to a camera after it has come.
  for (const std::string& remark : listed.remarks) {
    if (!remarks_ || remarks_->contains(remark)) trouble.append(" ").append(remark);
  }
  remarks_.emplace(listed.remarks.begin(), listed.remarks.end());
  tell(CameraState::kAbsent, trouble);
  return false;
}

Status CameraFinder::start(const std::string& id) {
  auto camera = cameras_.make(id);
  if (!camera) return camera.error();
  if (const Status started = (*camera)->start(options_, sink_); !started) return started.error();
  camera_ = std::move(camera).value();
  return Done{};
}

void CameraFinder::tell(CameraState state, const std::string& sentence) {
  if (std::exchange(told_, sentence) == sentence) return;
  sink_(CameraReport{clock_.now(), state, sentence});
}

}  // namespace plumbline::service
