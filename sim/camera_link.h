// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera.h"

namespace plumbline::sim {

// The pixels of a simulated frame.
struct FramePixels {
  PixelFormat format = PixelFormat::kGrey;
  int width_px = 0;
  int height_px = 0;
  std::vector<std::uint8_t> bytes;  // rows without padding
};

// What every simulated camera does with its sink: lends a few buffers, numbers frames, counts those
// that no buffer was free for, says each change of state once. One thread.
class CameraLink {
 public:
  CameraLink(Camera::Sink sink, int buffers)
      : sink_(std::move(sink)), buffers_(buffers), lent_(std::make_shared<int>(0)) {}

  bool has_free_buffer() const { return *lent_ < buffers_; }
  void lose() { ++pending_lost_; }
  void deliver(HostTime now, Frame frame, FramePixels picture);  // lost if no buffer is free
  void report(HostTime now, CameraState state, const std::string& sentence);
  void notice(HostTime now, const std::string& sentence) { sink_(CameraNotice{now, sentence}); }
  std::optional<CameraState> state() const { return reported_; }

 private:
  Camera::Sink sink_;
  int buffers_;
  std::shared_ptr<int> lent_;  // by frames that may outlive the camera
  std::uint64_t next_ = 0;
  std::uint64_t pending_lost_ = 0;
  std::optional<CameraState> reported_;
};

// The sentence for a size or format that is not `picture`'s, or nothing.
std::optional<Error> other_mode_than(const CameraOptions& options, PixelFormat format, int width_px,
                                     int height_px);

}  // namespace plumbline::sim
