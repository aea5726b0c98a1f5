// SPDX-License-Identifier: MIT
#include "drivers/camera/v4l2_planes.h"

#include <cerrno>

namespace plumbline {
namespace {

bool has_planes(const v4l2_format& format) {
  return format.type == V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
}

V4l2FrameFormat frame_format_of(const v4l2_format& format) {
  if (has_planes(format)) {
    const v4l2_pix_format_mplane& pix = format.fmt.pix_mp;
    return {pix.width,      pix.height,    pix.pixelformat, pix.plane_fmt[0].bytesperline,
            pix.colorspace, pix.ycbcr_enc, pix.quantization};
  }
  const v4l2_pix_format& pix = format.fmt.pix;
  return {pix.width,      pix.height,    pix.pixelformat, pix.bytesperline,
          pix.colorspace, pix.ycbcr_enc, pix.quantization};
}

int take(const v4l2_format& answer, V4l2FrameFormat& format) {
  if (has_planes(answer) && answer.fmt.pix_mp.num_planes != 1) return EINVAL;
  format = frame_format_of(answer);
  return 0;
}

}  // namespace

int get_format(const V4l2Device& device, V4l2FrameFormat& format) {
  v4l2_format current{};
  current.type = device.capture_type();
  const int error = device.call(VIDIOC_G_FMT, &current);
  return error != 0 ? error : take(current, format);
}

int set_format(const V4l2Device& device, V4l2FrameFormat& format) {
  v4l2_format wanted{};
  wanted.type = device.capture_type();
  if (has_planes(wanted)) {
    wanted.fmt.pix_mp.width = format.width;
    wanted.fmt.pix_mp.height = format.height;
    wanted.fmt.pix_mp.pixelformat = format.fourcc;
    wanted.fmt.pix_mp.field = V4L2_FIELD_NONE;
    wanted.fmt.pix_mp.num_planes = 1;
  } else {
    wanted.fmt.pix.width = format.width;
    wanted.fmt.pix.height = format.height;
    wanted.fmt.pix.pixelformat = format.fourcc;
    wanted.fmt.pix.field = V4L2_FIELD_NONE;
  }
  const int error = device.call(VIDIOC_S_FMT, &wanted);
  return error != 0 ? error : take(wanted, format);
}

V4l2Slot::V4l2Slot(const V4l2Device& device, std::uint32_t index) {
  buffer_.index = index;
  buffer_.type = device.capture_type();
  buffer_.memory = V4L2_MEMORY_MMAP;
}

v4l2_buffer* V4l2Slot::argument() {
  if (has_planes()) {
    buffer_.m.planes = planes_.data();
    buffer_.length = static_cast<std::uint32_t>(planes_.size());
  }
  return &buffer_;
}

std::size_t V4l2Slot::map_offset() const {
  return has_planes() ? planes_[0].m.mem_offset : buffer_.m.offset;
}

std::size_t V4l2Slot::map_bytes() const {
  return has_planes() ? planes_[0].length : buffer_.length;
}

std::size_t V4l2Slot::frame_begin() const { return has_planes() ? planes_[0].data_offset : 0; }

std::size_t V4l2Slot::frame_end() const {
  return has_planes() ? planes_[0].bytesused : buffer_.bytesused;
}

}  // namespace plumbline
