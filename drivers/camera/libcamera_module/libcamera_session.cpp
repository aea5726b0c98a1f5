// SPDX-License-Identifier: MIT
#include "drivers/camera/libcamera_module/libcamera_session.h"

#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <utility>

#include "drivers/camera/mode_choice.h"

namespace plumbline {
namespace {

constexpr unsigned kBuffers = 5;

libcamera::PixelFormat theirs(const libcamera::StreamConfiguration& stream, PixelFormat ours) {
  for (const libcamera::PixelFormat& format : stream.formats().pixelformats()) {
    if (pixel_format_of(format) == ours) return format;
  }
  return stream.pixelFormat;
}

bool is_full_range(const libcamera::StreamConfiguration& stream) {
  return stream.colorSpace && stream.colorSpace->range == libcamera::ColorSpace::Range::Full;
}

RawImage layout_of(const libcamera::StreamConfiguration& stream, PixelFormat format) {
  RawImage layout;
  layout.format = format;
  layout.width_px = static_cast<int>(stream.size.width);
  layout.height_px = static_cast<int>(stream.size.height);
  layout.range = is_full_range(stream) ? LumaRange::kFull : LumaRange::kLimited;
  if (format != PixelFormat::kMjpeg) layout.stride_bytes = stream.stride;
  return layout;
}

// How a plane lies in the memory of its descriptor.
std::size_t end_of(const libcamera::FrameBuffer::Plane& plane) {
  const bool has_offset = plane.offset != libcamera::FrameBuffer::Plane::kInvalidOffset;
  return (has_offset ? plane.offset : 0) + plane.length;
}

}  // namespace

MappedBuffers::~MappedBuffers() {
  for (const auto& [fd, mapping] : of_fd_) ::munmap(mapping.start, mapping.length);
}

bool MappedBuffers::map(const libcamera::FrameBuffer& buffer) {
  std::map<int, std::size_t> length;
  for (const auto& plane : buffer.planes()) {
    std::size_t& end = length[plane.fd.get()];
    end = std::max(end, end_of(plane));
  }
  for (const auto& [fd, bytes] : length) {
    if (of_fd_.count(fd) != 0) continue;
    void* start = ::mmap(nullptr, bytes, PROT_READ, MAP_SHARED, fd, 0);
    if (start == MAP_FAILED) return false;
    of_fd_[fd] = {start, bytes};
  }
  return true;
}

std::span<const std::uint8_t> MappedBuffers::bytes_of(const libcamera::FrameBuffer& buffer) const {
  const auto& planes = buffer.planes();
  if (planes.empty() || of_fd_.count(planes[0].fd.get()) == 0) return {};
  const Mapping& mapping = of_fd_.at(planes[0].fd.get());
  const bool has_offset = planes[0].offset != libcamera::FrameBuffer::Plane::kInvalidOffset;
  const std::size_t first = has_offset ? planes[0].offset : 0;
  // What was filled: of the last plane as much as the camera says.
  const std::size_t last = planes.size() - 1;
  std::size_t end = 0;
  for (std::size_t i = 0; i <= last; ++i) {
    if (planes[i].fd.get() != planes[0].fd.get()) return {};
    const auto filled = buffer.metadata().planes();
    const std::size_t used = i < filled.size() ? filled[i].bytesused : planes[i].length;
    end = end_of(planes[i]) - planes[i].length + std::min<std::size_t>(used, planes[i].length);
  }
  return {static_cast<const std::uint8_t*>(mapping.start) + first, end - first};
}

LibcameraSession::LibcameraSession(std::shared_ptr<libcamera::Camera> camera,
                                   const CameraOptions& options, Callbacks callbacks)
    : camera_(std::move(camera)), options_(options), callbacks_(std::move(callbacks)) {
  camera_->requestCompleted.connect(this, &LibcameraSession::on_completed);
  camera_->disconnected.connect(this, &LibcameraSession::on_disconnected);
}

std::unique_ptr<LibcameraSession> LibcameraSession::open(std::shared_ptr<libcamera::Camera> camera,
                                                         const CameraOptions& options,
                                                         std::optional<double> lens_position,
                                                         Callbacks callbacks,
                                                         LibcameraFailure& failure) {
  std::unique_ptr<LibcameraSession> session(
      new LibcameraSession(std::move(camera), options, std::move(callbacks)));
  const std::optional<LibcameraFailure> failed = session->configure(lens_position);
  if (!failed) return session;
  failure = *failed;
  return nullptr;
}

// Requests refer to the camera, and after a pulled plug never complete: they go before it does.
LibcameraSession::~LibcameraSession() {
  if (started_) camera_->stop();
  camera_->requestCompleted.disconnect(this);
  camera_->disconnected.disconnect(this);
  requests_.clear();
  if (allocator_ && stream_ != nullptr) allocator_->free(stream_);
  allocator_.reset();
  if (acquired_) camera_->release();
}

LibcameraFailure LibcameraSession::failure(const std::string& what, int result) const {
  const bool gone = result == -ENODEV;
  const bool held = result == -EBUSY;
  const std::string why =
      held ? "another program holds it; end that program" : std::strerror(-result);
  return {gone ? CameraState::kAbsent : CameraState::kFailing, !held,
          "Cannot " + what + " camera '" + camera_->id() + "': " + why + "."};
}

std::optional<LibcameraFailure> LibcameraSession::configure(std::optional<double> lens_position) {
  if (const int result = camera_->acquire(); result != 0) return failure("open", result);
  acquired_ = true;
  const auto configuration = configuration_for(*camera_, options_);
  if (!configuration || configuration->empty()) return failure("get a mode from", -EINVAL);
  if (auto failed = choose(*configuration)) return failed;
  if (const int result = camera_->configure(configuration.get()); result != 0) {
    return failure("set the mode of", result);
  }
  const libcamera::StreamConfiguration& stream = configuration->at(0);
  stream_ = stream.stream();
  layout_ = layout_of(stream, *pixel_format_of(stream.pixelFormat));
  settings_ = settings_for(*camera_, options_, lens_position);
  note_exposure(HostTime{});  // before all frames
  if (auto failed = make_requests()) return failed;
  return start();
}

std::optional<LibcameraFailure> LibcameraSession::choose(
    libcamera::CameraConfiguration& configuration) {
  libcamera::StreamConfiguration& stream = configuration.at(0);
  const std::vector<CameraMode> modes = modes_of(configuration);
  const Result<CameraMode> mode = choose_mode(modes, options_);
  if (!mode) return LibcameraFailure{CameraState::kFailing, false, mode.error().sentence};
  stream.size = {static_cast<unsigned>(mode->width_px), static_cast<unsigned>(mode->height_px)};
  stream.pixelFormat = theirs(stream, mode->format);
  stream.bufferCount = kBuffers;
  const bool possible = configuration.validate() != libcamera::CameraConfiguration::Invalid;
  const bool as_asked = possible && static_cast<int>(stream.size.width) == mode->width_px &&
                        static_cast<int>(stream.size.height) == mode->height_px &&
                        pixel_format_of(stream.pixelFormat) == mode->format;
  if (as_asked) return std::nullopt;
  return LibcameraFailure{CameraState::kFailing, false,
                          "Camera '" + camera_->id() + "' has no mode " +
                              std::to_string(mode->width_px) + " x " +
                              std::to_string(mode->height_px) + " " + name_of(mode->format) +
                              "; it has " + text_of(modes) + "."};
}

std::optional<LibcameraFailure> LibcameraSession::make_requests() {
  allocator_ = std::make_unique<libcamera::FrameBufferAllocator>(camera_);
  if (const int made = allocator_->allocate(stream_); made < 0) {
    return failure("get memory for", made);
  }
  memory_ = std::make_shared<MappedBuffers>();
  for (const auto& buffer : allocator_->buffers(stream_)) {
    std::unique_ptr<libcamera::Request> request = camera_->createRequest();
    const bool made =
        request && request->addBuffer(stream_, buffer.get()) == 0 && memory_->map(*buffer);
    if (!made) return failure("get memory for", -ENOMEM);
    if (layout_.format == PixelFormat::kNv12 && buffer->planes().size() > 1) {
      layout_.second_plane_offset = buffer->planes()[1].offset - buffer->planes()[0].offset;
    }
    requests_.push_back(std::move(request));
  }
  return std::nullopt;
}

std::optional<LibcameraFailure> LibcameraSession::start() {
  if (const int result = camera_->start(&settings_.controls); result != 0) {
    return failure("start", result);
  }
  started_ = true;
  // Pipelines that take no controls at the start take them with the first request.
  changed_ = settings_.controls;
  for (const auto& request : requests_) {
    if (!queue(request.get())) return failure("start", -EIO);
  }
  return std::nullopt;
}

void LibcameraSession::note_exposure(HostTime set_at) {
  const auto us = settings_.controls.get(libcamera::controls::ExposureTime);
  if (us) exposures_.set(set_at, std::chrono::microseconds(*us));
}

const libcamera::FrameBuffer* LibcameraSession::buffer_of(const libcamera::Request& request) const {
  return request.findBuffer(stream_);
}

bool LibcameraSession::queue(libcamera::Request* request) {
  if (changed_) request->controls() = *std::exchange(changed_, std::nullopt);
  return camera_->queueRequest(request) == 0;
}

void LibcameraSession::limit_exposure(std::chrono::microseconds longest, HostTime now) {
  options_.longest_exposure = longest;
  libcamera::ControlList controls(libcamera::controls::controls);
  plumbline::set_exposure(camera_->controls(), options_, controls);
  plumbline::set_exposure(camera_->controls(), options_, settings_.controls);
  changed_ = controls;
  note_exposure(now);
}

}  // namespace plumbline
