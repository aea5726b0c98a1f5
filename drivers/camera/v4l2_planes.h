// SPDX-License-Identifier: MIT
#pragma once

#include <linux/videodev2.h>

#include <array>
#include <cstddef>
#include <cstdint>

#include "drivers/camera/v4l2_device.h"

namespace plumbline {

// V4L2 has two interfaces for the same work: the older one, and the multi-planar one, in which a
// frame may lie in several pieces of memory. A device has either. What differs is all in here; of
// the multi-planar one, formats that lie in one piece are used (NV12, not NM12).

// How the frames of a stream are, as VIDIOC_G_FMT and VIDIOC_S_FMT have it.
struct V4l2FrameFormat {
  std::uint32_t width = 0;
  std::uint32_t height = 0;
  std::uint32_t fourcc = 0;
  std::uint32_t stride_bytes = 0;
  std::uint32_t colorspace = 0;
  std::uint32_t ycbcr_encoding = 0;
  std::uint32_t quantization = 0;
};

// 0 or errno; EINVAL too where frames lie in several pieces.
int get_format(const V4l2Device& device, V4l2FrameFormat& format);

// Asks for size and fourcc; `format` is then what the device made of it. 0 or errno, as above.
int set_format(const V4l2Device& device, V4l2FrameFormat& format);

// One buffer of a stream, as ioctls about buffers take and fill it.
class V4l2Slot {
 public:
  explicit V4l2Slot(const V4l2Device& device, std::uint32_t index = 0);

  // For an ioctl; valid until the slot is moved or copied.
  v4l2_buffer* argument();

  std::uint32_t index() const { return buffer_.index; }
  std::uint32_t sequence() const { return buffer_.sequence; }
  std::uint32_t flags() const { return buffer_.flags; }
  timeval timestamp() const { return buffer_.timestamp; }

  // Where the kernel maps it from, and how long that is.
  std::size_t map_offset() const;
  std::size_t map_bytes() const;

  // Where in it the frame begins and ends.
  std::size_t frame_begin() const;
  std::size_t frame_end() const;

 private:
  bool has_planes() const { return buffer_.type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE; }

  v4l2_buffer buffer_{};
  std::array<v4l2_plane, VIDEO_MAX_PLANES> planes_{};
};

}  // namespace plumbline
