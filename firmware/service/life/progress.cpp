// SPDX-License-Identifier: MIT
#include "firmware/service/life/progress.h"

namespace plumbline::service {

void Progress::lived() {
  const std::lock_guard lock(mutex_);
  ++rounds_;
}

void Progress::heard(const capture::Input& input) {
  const auto* camera = std::get_if<capture::CameraSeen>(&input.what);
  if (camera == nullptr && !std::holds_alternative<capture::FrameSeen>(input.what)) return;
  const std::lock_guard lock(mutex_);
  if (camera != nullptr) streams_ = camera->streaming;
  sign_ = input.now;
}

Progress::State Progress::state(HostTime now, const flight::WorkAtHand& work) const {
  const std::lock_guard lock(mutex_);
  State state;
  state.rounds = rounds_;
  state.disk_is_late = work.storing && now - *work.storing > options_.storing;
  if (work.encoding && now - *work.encoding > options_.encoding) {
    state.hangs = "A photo is being encoded, and does not get done.";
  } else if (options_.needs_frames && streams_ && now - sign_ > options_.frame) {
    state.hangs = "The camera's driver says that it streams, and nothing comes from it.";
  }
  return state;
}

}  // namespace plumbline::service
