// SPDX-License-Identifier: MIT
#pragma once

#include <linux/videodev2.h>

#include <string>
#include <vector>

#include "drivers/camera.h"
#include "drivers/camera/control_plan.h"

namespace plumbline {

// An open video device, as thin as can be: requests in, errno out. Closed by the destructor. Any
// thread may call.
class V4l2Device {
 public:
  explicit V4l2Device(std::string path);
  ~V4l2Device();
  V4l2Device(const V4l2Device&) = delete;
  V4l2Device& operator=(const V4l2Device&) = delete;

  int open_error() const { return open_error_; }  // errno; 0: open
  int fd() const { return fd_; }
  const std::string& path() const { return path_; }

  // V4L2_BUF_TYPE_VIDEO_CAPTURE, or ..._MPLANE where frames are had by that interface only.
  std::uint32_t capture_type() const { return capture_type_; }

  // One ioctl, again when a signal interrupts it. 0 or errno.
  int call(unsigned long request, void* argument) const;

 private:
  std::string path_;
  int fd_ = -1;
  int open_error_ = 0;
  std::uint32_t capture_type_ = V4L2_BUF_TYPE_VIDEO_CAPTURE;
};

// What failed, and what to do about it. `what`: "open", "start streaming".
std::string sentence_of(const std::string& path, const std::string& what, int error);

// What it is: the kernel's names, and whether frames can be streamed from it.
struct V4l2Identity {
  std::string card;    // the model
  std::string driver;  // "uvcvideo"
  std::string bus;     // where it is plugged in
  bool streams_video = false;
  std::string why_not;  // if it does not
};
V4l2Identity identity_of(const V4l2Device& device);

// All controls with their values, in the driver's order.
std::vector<V4l2Control> controls_of(const V4l2Device& device);

// The formats that RawImage can hold, in all their sizes, each at its highest rate. Of a range of
// sizes the largest.
std::vector<CameraMode> modes_of(const V4l2Device& device);

// The format of V4L2's code; the way back is code_of().
std::optional<PixelFormat> pixel_format_of_fourcc(std::uint32_t fourcc);

}  // namespace plumbline
