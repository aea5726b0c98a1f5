// SPDX-License-Identifier: MIT
#include "drivers/camera/v4l2_device.h"

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/camera/v4l2_planes.h"

namespace plumbline {
namespace {

// A driver that never says "that was all" must not keep us for ever.
constexpr std::uint32_t kMostEntries = 256;

template <std::size_t N>
std::string text(const __u8 (&field)[N]) {
  const auto* begin = reinterpret_cast<const char*>(field);
  return {begin, std::find(begin, begin + N, '\0')};
}

// Of this node, as opposed to all nodes of its driver.
std::uint32_t capabilities(const v4l2_capability& found) {
  const bool split = (found.capabilities & V4L2_CAP_DEVICE_CAPS) != 0;
  return split ? found.device_caps : found.capabilities;
}

std::string advice(int error) {
  switch (error) {
    case EACCES:
    case EPERM:
      return "you have no right to it; add your user to the group video and log in again";
    case EBUSY:
      return "another program holds it; end that program";
    case ENOENT:
    case ENODEV:
    case ENXIO:
      return "there is no such camera; plug it in, or look which there are with plumbline camera";
    default:
      return std::strerror(error);
  }
}

bool is_value(const v4l2_query_ext_ctrl& query) {
  return query.type == V4L2_CTRL_TYPE_INTEGER || query.type == V4L2_CTRL_TYPE_BOOLEAN ||
         query.type == V4L2_CTRL_TYPE_MENU || query.type == V4L2_CTRL_TYPE_INTEGER_MENU;
}

std::vector<std::int64_t> menu_of(const V4l2Device& device, const v4l2_query_ext_ctrl& query) {
  std::vector<std::int64_t> choices;
  const bool menu = query.type == V4L2_CTRL_TYPE_MENU || query.type == V4L2_CTRL_TYPE_INTEGER_MENU;
  for (std::int64_t i = query.minimum; menu && i <= query.maximum && i < kMostEntries; ++i) {
    v4l2_querymenu entry{};
    entry.id = query.id;
    entry.index = static_cast<std::uint32_t>(i);
    if (device.call(VIDIOC_QUERYMENU, &entry) == 0) choices.push_back(i);
  }
  return choices;
}

V4l2Control control_of(const V4l2Device& device, const v4l2_query_ext_ctrl& query) {
  V4l2Control control;
  control.id = query.id;
  control.name = query.name;
  control.minimum = query.minimum;
  control.maximum = query.maximum;
  control.step = static_cast<std::int64_t>(query.step);
  control.default_value = query.default_value;
  control.read_only = (query.flags & V4L2_CTRL_FLAG_READ_ONLY) != 0;
  control.menu = menu_of(device, query);
  v4l2_control value{query.id, 0};
  if (device.call(VIDIOC_G_CTRL, &value) == 0) control.value = value.value;
  return control;
}

// Frames a second of the shortest interval; empty where the driver does not say.
std::optional<double> fastest(const V4l2Device& device, std::uint32_t fourcc, int width,
                              int height) {
  std::optional<double> best;
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_frmivalenum entry{};
    entry.index = i;
    entry.pixel_format = fourcc;
    entry.width = static_cast<std::uint32_t>(width);
    entry.height = static_cast<std::uint32_t>(height);
    if (device.call(VIDIOC_ENUM_FRAMEINTERVALS, &entry) != 0) break;
    const bool discrete = entry.type == V4L2_FRMIVAL_TYPE_DISCRETE;
    const v4l2_fract interval = discrete ? entry.discrete : entry.stepwise.min;
    if (interval.numerator == 0) break;
    const double rate = static_cast<double>(interval.denominator) / interval.numerator;
    best = std::max(best.value_or(rate), rate);
    if (!discrete) break;
  }
  return best;
}

void add_sizes(const V4l2Device& device, PixelFormat format, std::vector<CameraMode>& modes) {
  const std::uint32_t fourcc = code_of(format);
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_frmsizeenum entry{};
    entry.index = i;
    entry.pixel_format = fourcc;
    if (device.call(VIDIOC_ENUM_FRAMESIZES, &entry) != 0) return;
    const bool discrete = entry.type == V4L2_FRMSIZE_TYPE_DISCRETE;
    const int width = static_cast<int>(discrete ? entry.discrete.width : entry.stepwise.max_width);
    const int height =
        static_cast<int>(discrete ? entry.discrete.height : entry.stepwise.max_height);
    modes.push_back({width, height, format, fastest(device, fourcc, width, height)});
    if (!discrete) return;
  }
}

// Drivers of fixed sources list no sizes: then the size is what it is.
void add_current_size(const V4l2Device& device, PixelFormat format,
                      std::vector<CameraMode>& modes) {
  V4l2FrameFormat current;
  if (get_format(device, current) != 0) return;
  modes.push_back(
      {static_cast<int>(current.width), static_cast<int>(current.height), format, std::nullopt});
}

}  // namespace

V4l2Device::V4l2Device(std::string path) : path_(std::move(path)) {
  fd_ = ::open(path_.c_str(), O_RDWR | O_NONBLOCK | O_CLOEXEC);
  if (fd_ < 0) open_error_ = errno;
  v4l2_capability found{};
  if (fd_ < 0 || call(VIDIOC_QUERYCAP, &found) != 0) return;
  const std::uint32_t can = capabilities(found);
  const bool by_planes = (can & V4L2_CAP_VIDEO_CAPTURE_MPLANE) != 0;
  if (by_planes && (can & V4L2_CAP_VIDEO_CAPTURE) == 0) {
    capture_type_ = V4L2_BUF_TYPE_VIDEO_CAPTURE_MPLANE;
  }
}

V4l2Device::~V4l2Device() {
  if (fd_ >= 0) ::close(fd_);
}

int V4l2Device::call(unsigned long request, void* argument) const {
  while (::ioctl(fd_, request, argument) != 0) {
    if (errno != EINTR) return errno;
  }
  return 0;
}

std::string sentence_of(const std::string& path, const std::string& what, int error) {
  return "Cannot " + what + " camera '" + path + "': " + advice(error) + ".";
}

V4l2Identity identity_of(const V4l2Device& device) {
  v4l2_capability found{};
  V4l2Identity identity;
  if (const int error = device.call(VIDIOC_QUERYCAP, &found); error != 0) {
    identity.why_not = error == ENOTTY || error == EINVAL
                           ? "'" + device.path() + "' is not a camera."
                           : sentence_of(device.path(), "ask", error);
    return identity;
  }
  identity.card = text(found.card);
  identity.driver = text(found.driver);
  identity.bus = text(found.bus_info);
  const std::uint32_t can = capabilities(found);
  if ((can & (V4L2_CAP_VIDEO_CAPTURE | V4L2_CAP_VIDEO_CAPTURE_MPLANE)) == 0) {
    identity.why_not = "'" + device.path() + "' (" + identity.card +
                       ") is a video device that is not a camera; see plumbline camera for those "
                       "that are.";
  } else if ((can & V4L2_CAP_STREAMING) == 0) {
    identity.why_not = "'" + device.path() + "' (" + identity.card +
                       ") cannot stream into memory, which is how frames are taken here.";
  }
  identity.streams_video = identity.why_not.empty();
  return identity;
}

std::vector<V4l2Control> controls_of(const V4l2Device& device) {
  std::vector<V4l2Control> controls;
  v4l2_query_ext_ctrl query{};
  query.id = V4L2_CTRL_FLAG_NEXT_CTRL;
  while (controls.size() < kMostEntries && device.call(VIDIOC_QUERY_EXT_CTRL, &query) == 0) {
    const bool usable = (query.flags & V4L2_CTRL_FLAG_DISABLED) == 0 && is_value(query);
    if (usable) controls.push_back(control_of(device, query));
    query.id |= V4L2_CTRL_FLAG_NEXT_CTRL;
  }
  return controls;
}

std::vector<CameraMode> modes_of(const V4l2Device& device) {
  std::vector<CameraMode> modes;
  for (std::uint32_t i = 0; i < kMostEntries; ++i) {
    v4l2_fmtdesc entry{};
    entry.index = i;
    entry.type = device.capture_type();
    if (device.call(VIDIOC_ENUM_FMT, &entry) != 0) break;
    const std::optional<PixelFormat> format = pixel_format_of_fourcc(entry.pixelformat);
    if (!format) continue;
    const std::size_t before = modes.size();
    add_sizes(device, *format, modes);
    if (modes.size() == before) add_current_size(device, *format, modes);
  }
  return modes;
}

std::optional<PixelFormat> pixel_format_of_fourcc(std::uint32_t fourcc) {
  if (fourcc == V4L2_PIX_FMT_JPEG) return PixelFormat::kMjpeg;
  return pixel_format_of_code(fourcc);
}

}  // namespace plumbline
