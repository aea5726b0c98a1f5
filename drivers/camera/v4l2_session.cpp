// SPDX-License-Identifier: MIT
#include "drivers/camera/v4l2_session.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <utility>

#include "drivers/camera/mode_choice.h"

namespace plumbline {
namespace {

constexpr unsigned kBuffers = 5;  // one or two being filled, one or two in a ring, one on its way

bool is_gone(int error) { return error == ENOENT || error == ENODEV || error == ENXIO; }

LumaRange range_of(const V4l2FrameFormat& pix) {
  const std::uint32_t quantization = pix.quantization != V4L2_QUANTIZATION_DEFAULT
                                         ? pix.quantization
                                         : static_cast<std::uint32_t>(V4L2_MAP_QUANTIZATION_DEFAULT(
                                               false, pix.colorspace, pix.ycbcr_encoding));
  return quantization == V4L2_QUANTIZATION_FULL_RANGE ? LumaRange::kFull : LumaRange::kLimited;
}

RawImage layout_of(const V4l2FrameFormat& pix, PixelFormat format) {
  RawImage layout;
  layout.format = format;
  layout.width_px = static_cast<int>(pix.width);
  layout.height_px = static_cast<int>(pix.height);
  layout.range = range_of(pix);
  if (format == PixelFormat::kMjpeg) return layout;
  layout.stride_bytes = pix.stride_bytes;
  if (format == PixelFormat::kNv12) {
    layout.second_plane_offset = static_cast<std::size_t>(pix.stride_bytes) * pix.height;
  }
  return layout;
}

std::optional<std::int64_t> value_of(const V4l2Device& device, std::uint32_t id) {
  v4l2_control control{id, 0};
  if (device.call(VIDIOC_G_CTRL, &control) != 0) return std::nullopt;
  return control.value;
}

// uvcvideo stamps the first packet of a frame and calls that its start of exposure, unless it is
// told to reckon back with the camera's own clock.
bool uvc_reckons_with_the_cameras_clock() {
  const int fd = ::open("/sys/module/uvcvideo/parameters/hwtimestamps", O_RDONLY | O_CLOEXEC);
  if (fd < 0) return false;
  char value = '0';
  const bool read = ::read(fd, &value, 1) == 1;
  ::close(fd);
  return read && (value == '1' || value == 'Y');
}

StampMeaning meaning_of(std::uint32_t flags, const std::string& driver) {
  const bool monotonic =
      (flags & V4L2_BUF_FLAG_TIMESTAMP_MASK) == V4L2_BUF_FLAG_TIMESTAMP_MONOTONIC;
  if (!monotonic) return StampMeaning::kArrival;
  const bool start = (flags & V4L2_BUF_FLAG_TSTAMP_SRC_MASK) == V4L2_BUF_FLAG_TSTAMP_SRC_SOE;
  if (!start) return StampMeaning::kEndOfFrame;
  static const bool reckons = uvc_reckons_with_the_cameras_clock();
  return driver == "uvcvideo" && !reckons ? StampMeaning::kFirstPacket
                                          : StampMeaning::kStartOfExposure;
}

}  // namespace

std::unique_ptr<V4l2Session> V4l2Session::open(const std::string& path,
                                               const CameraOptions& options,
                                               std::optional<std::int64_t> focus,
                                               V4l2Failure& failure) {
  std::unique_ptr<V4l2Session> session(new V4l2Session(path, options));
  const std::optional<V4l2Failure> failed = session->configure(focus);
  if (!failed) return session;
  failure = *failed;
  return nullptr;
}

V4l2Session::~V4l2Session() {
  if (buffers_) buffers_->detach();
}

std::optional<V4l2Failure> V4l2Session::configure(std::optional<std::int64_t> focus) {
  if (device_.open_error() != 0) return failure("open", device_.open_error());
  identity_ = identity_of(device_);
  if (!identity_.streams_video) {
    const bool gone =
        identity_.card.empty() && identity_.why_not.find("not a camera") == std::string::npos;
    return V4l2Failure{gone ? CameraState::kAbsent : CameraState::kFailing, gone,
                       identity_.why_not};
  }
  show_whole_sensor();
  stand_upright();
  if (auto failed = set_mode()) return failed;
  controls_ = controls_of(device_);
  apply(plan_controls(controls_, options_, focus));
  read_interior();
  subscribe();
  return stream();
}

V4l2Failure V4l2Session::failure(const std::string& what, int error) const {
  const bool hopeless = error == EACCES || error == EPERM || error == EBUSY;
  return {is_gone(error) ? CameraState::kAbsent : CameraState::kFailing, !hopeless,
          sentence_of(device_.path(), what, error)};
}

// A crop left by another program would make it another camera. Many cannot crop: no harm.
void V4l2Session::show_whole_sensor() {
  v4l2_selection whole{};
  whole.type = V4L2_BUF_TYPE_VIDEO_CAPTURE;  // of either interface
  whole.target = V4L2_SEL_TGT_CROP_DEFAULT;
  if (device_.call(VIDIOC_G_SELECTION, &whole) != 0) return;
  whole.target = V4L2_SEL_TGT_CROP;
  device_.call(VIDIOC_S_SELECTION, &whole);
}

// Before the mode is chosen, because a Bayer sensor that is mirrored has another order of colours.
void V4l2Session::stand_upright() {
  for (const std::uint32_t id : {std::uint32_t{V4L2_CID_HFLIP}, std::uint32_t{V4L2_CID_VFLIP},
                                 std::uint32_t{V4L2_CID_ROTATE}}) {
    v4l2_control upright{id, 0};
    device_.call(VIDIOC_S_CTRL, &upright);  // many have none, and of what is refused apply() tells
  }
}

std::optional<V4l2Failure> V4l2Session::set_mode() {
  const std::vector<CameraMode> modes = modes_of(device_);
  const Result<CameraMode> mode = choose_mode(modes, options_);
  if (!mode) return V4l2Failure{CameraState::kFailing, false, mode.error().sentence};
  if (const int error = set_format(*mode); error != 0) return failure("set the mode of", error);
  const bool as_asked = layout_.width_px == mode->width_px &&
                        layout_.height_px == mode->height_px && layout_.format == mode->format;
  if (!as_asked) {
    return V4l2Failure{CameraState::kFailing, false,
                       "Camera '" + device_.path() + "' has no mode " +
                           std::to_string(mode->width_px) + " x " +
                           std::to_string(mode->height_px) + " " + name_of(mode->format) +
                           "; it has " + text_of(modes) + "."};
  }
  set_rate(*mode);
  return std::nullopt;
}

int V4l2Session::set_format(const CameraMode& mode) {
  V4l2FrameFormat format;
  format.width = static_cast<std::uint32_t>(mode.width_px);
  format.height = static_cast<std::uint32_t>(mode.height_px);
  format.fourcc = code_of(mode.format);
  const int error = plumbline::set_format(device_, format);
  if (error != 0) return error;
  layout_ = layout_of(format, pixel_format_of_fourcc(format.fourcc).value_or(PixelFormat::kGrey));
  return 0;
}

void V4l2Session::set_rate(const CameraMode& mode) {
  v4l2_streamparm parameters{};
  parameters.type = device_.capture_type();
  const std::optional<double> rate =
      options_.frames_per_s ? options_.frames_per_s : mode.frames_per_s;
  if (rate && *rate > 0) {
    parameters.parm.capture.timeperframe = {
        1000, static_cast<std::uint32_t>(std::lround(1000.0 * *rate))};
    device_.call(VIDIOC_S_PARM, &parameters);
  }
  if (device_.call(VIDIOC_G_PARM, &parameters) != 0) return;
  const v4l2_fract interval = parameters.parm.capture.timeperframe;
  if (interval.numerator == 0 || interval.denominator == 0) return;
  period_ = std::chrono::nanoseconds(std::llround(1e9 * interval.numerator / interval.denominator));
}

void V4l2Session::apply(const ControlPlan& plan) {
  notices_ = plan.notices;
  for (const ControlSetting& setting : plan.settings) set_control(setting);
  if (plan.exposure_known) read_exposure(HostTime{});  // before all frames
}

void V4l2Session::set_control(const ControlSetting& setting) {
  const V4l2Control* control = find_control(controls_, setting.id);
  v4l2_control value{setting.id, static_cast<std::int32_t>(setting.value)};
  const int error = device_.call(VIDIOC_S_CTRL, &value);
  if (error == 0 || control == nullptr || control->value == setting.value) return;
  notices_.push_back("Camera '" + device_.path() + "' does not let its control '" + control->name +
                     "' be set to " + std::to_string(setting.value) + " (" +
                     sentence_of(device_.path(), "set", error) + ")");
}

void V4l2Session::read_exposure(HostTime set_at) {
  const auto value = value_of(device_, V4L2_CID_EXPOSURE_ABSOLUTE);
  if (value) exposures_.set(set_at, std::chrono::microseconds(100 * *value));
}

void V4l2Session::read_interior() {
  interior_ = {layout_.width_px, layout_.height_px, layout_.format,
               value_of(device_, V4L2_CID_FOCUS_ABSOLUTE),
               value_of(device_, V4L2_CID_ZOOM_ABSOLUTE)};
}

void V4l2Session::subscribe() {
  for (const std::uint32_t id :
       {std::uint32_t{V4L2_CID_FOCUS_ABSOLUTE}, std::uint32_t{V4L2_CID_ZOOM_ABSOLUTE}}) {
    v4l2_event_subscription wanted{};
    wanted.type = V4L2_EVENT_CTRL;
    wanted.id = id;
    device_.call(VIDIOC_SUBSCRIBE_EVENT, &wanted);
  }
  v4l2_event_subscription wanted{};
  wanted.type = V4L2_EVENT_SOURCE_CHANGE;
  device_.call(VIDIOC_SUBSCRIBE_EVENT, &wanted);
}

std::optional<V4l2Failure> V4l2Session::stream() {
  if (const int error = V4l2Buffers::make(device_, kBuffers, buffers_); error != 0) {
    return failure("get memory for", error);
  }
  std::uint32_t type = device_.capture_type();
  if (const int error = device_.call(VIDIOC_STREAMON, &type); error != 0) {
    return failure("start", error);
  }
  return std::nullopt;
}

int V4l2Session::dequeue(V4l2Slot& filled) {
  filled = V4l2Slot(device_);
  return device_.call(VIDIOC_DQBUF, filled.argument());
}

ExposureTiming V4l2Session::timing_of(const V4l2Slot& filled, HostTime arrival) const {
  const timeval time = filled.timestamp();
  const HostTime stamp(std::chrono::seconds(time.tv_sec) + std::chrono::microseconds(time.tv_usec));
  // A stamp far from now is of another clock. (Drivers that reckon it from a steady rate may be a
  // little ahead.)
  const bool sane = stamp < arrival + period_ && arrival - stamp < std::chrono::seconds(10);
  ExposureModel model;
  if (sane) model.meaning = meaning_of(filled.flags(), identity_.driver);
  const HostTime event = model.meaning == StampMeaning::kArrival ? arrival : stamp;
  model.period = period_;
  model.exposure = exposures_.of_frame(event, period_);
  model.row_time = options_.row_time;
  model.rows = layout_.height_px;
  return exposure_of(event, model);
}

void V4l2Session::limit_exposure(std::chrono::microseconds longest, HostTime now) {
  options_.longest_exposure = longest;
  const std::optional<ControlSetting> setting = exposure_setting(controls_, longest);
  if (!setting) return;
  set_control(*setting);
  read_exposure(now);
}

bool V4l2Session::picture_changed(bool& lens_moved) {
  bool changed = false;
  v4l2_event event{};
  while (device_.call(VIDIOC_DQEVENT, &event) == 0) {
    changed = changed || event.type == V4L2_EVENT_SOURCE_CHANGE;
  }
  const CameraInterior before = interior_;
  read_interior();
  lens_moved = !(before == interior_);
  return changed;
}

}  // namespace plumbline
