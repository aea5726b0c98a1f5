// SPDX-License-Identifier: MIT
#include "firmware/flight/photo_encoder.h"

#include <optional>
#include <utility>

#include "edge/pixels/pixels.h"

namespace plumbline::flight {

void PhotoEncoder::add(Frame frame, Done done) {
  const std::lock_guard lock(mutex_);
  waiting_.push_back({std::move(frame), std::move(done)});
}

bool PhotoEncoder::work() {
  std::optional<Waiting> next;
  {
    const std::lock_guard lock(mutex_);
    if (waiting_.empty()) return false;
    next = std::move(waiting_.front());
    waiting_.pop_front();
  }
  auto jpeg = pixels::jpeg_of(*next->frame.image, quality_);
  next->frame.image.reset();  // the camera needs its buffer
  next->done(std::move(jpeg));
  return true;
}

}  // namespace plumbline::flight
