// SPDX-License-Identifier: MIT
#include "drivers/camera/v4l2_camera.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace plumbline {
namespace {

using std::chrono::milliseconds;

void raise(int event_fd) {
  const std::uint64_t one = 1;
  [[maybe_unused]] const ssize_t written = ::write(event_fd, &one, sizeof one);
}

void lower(int event_fd) {
  std::uint64_t count = 0;
  [[maybe_unused]] const ssize_t read = ::read(event_fd, &count, sizeof count);
}

CameraState state_of(int error) {
  return error == ENODEV || error == ENXIO ? CameraState::kAbsent : CameraState::kFailing;
}

}  // namespace

V4l2Camera::V4l2Camera(std::string path, const Clock& clock)
    : path_(std::move(path)), clock_(clock), watch_("'" + path_ + "'") {}

V4l2Camera::~V4l2Camera() { stop(); }

Status V4l2Camera::start(const CameraOptions& options, Sink sink) {
  if (thread_.joinable()) {
    return Error{"Camera '" + path_ + "' is already running; stop it before starting it anew."};
  }
  V4l2Failure failure;
  options_ = options;
  std::unique_ptr<V4l2Session> session = V4l2Session::open(path_, options_, std::nullopt, failure);
  if (!session && !failure.waiting_helps) return Error{failure.sentence};
  wake_fd_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
  if (wake_fd_ < 0) return Error{sentence_of(path_, "start", errno)};
  stopping_ = false;
  new_limit_us_ = -1;
  sink_ = std::move(sink);
  watch_ = CameraWatch("'" + path_ + "'");
  account_.restarted();
  said_.clear();
  thread_ = std::thread([this, first = std::move(session), failure]() mutable {
    if (first) {
      adopt(std::move(first));
    } else {
      fail(failure.state, failure.sentence);
    }
    run();
  });
  return Done{};
}

void V4l2Camera::stop() {
  if (!thread_.joinable()) return;
  stopping_ = true;
  raise(wake_fd_);
  thread_.join();
  ::close(wake_fd_);
  wake_fd_ = -1;
  sink_ = nullptr;
}

void V4l2Camera::limit_exposure(std::chrono::microseconds longest) {
  new_limit_us_ = longest.count();
  if (wake_fd_ >= 0) raise(wake_fd_);
}

Result<CameraDescription> V4l2Camera::describe() { return describe_v4l2(path_); }

void V4l2Camera::run() {
  while (!stopping_) {
    if (session_) {
      stream();
      session_.reset();
    }
    short happened = 0;
    wait(0, clock_.now() + watch_.next_retry(), happened);
    if (!stopping_) open_session();
  }
  session_.reset();
}

void V4l2Camera::open_session() {
  take_new_limit();
  const std::optional<std::string> path = device_path();
  if (!path) {
    fail(CameraState::kAbsent, sentence_of(path_, "find", ENODEV));
    return;
  }
  V4l2Failure failure;
  const auto focus = interior_ ? interior_->focus : std::nullopt;
  std::unique_ptr<V4l2Session> session = V4l2Session::open(*path, options_, focus, failure);
  if (!session) {
    fail(failure.state, failure.sentence);
    return;
  }
  adopt(std::move(session));
}

// The path given; or, while a frame of before is held, the kernel may number the camera anew.
std::optional<std::string> V4l2Camera::device_path() const {
  if (::access(path_.c_str(), F_OK) == 0 || identity_.card.empty()) return path_;
  for (const std::string& path : list_v4l2()) {
    const V4l2Device device(path);
    if (device.open_error() != 0) continue;
    const V4l2Identity other = identity_of(device);
    if (other.card == identity_.card && other.bus == identity_.bus) return path;
  }
  return std::nullopt;
}

void V4l2Camera::adopt(std::unique_ptr<V4l2Session> session) {
  session_ = std::move(session);
  if (identity_.card.empty()) identity_ = session_->identity();
  if (interior_ && !(*interior_ == session_->interior())) ++interior_number_;
  interior_ = session_->interior();
  const HostTime now = clock_.now();
  for (const std::string& notice : session_->notices()) {
    if (std::find(said_.begin(), said_.end(), notice) != said_.end()) continue;
    said_.push_back(notice);
    send(CameraNotice{now, notice});
  }
  account_.set_period(session_->period());
  account_.restarted();
  send(watch_.starting(now, session_->period()));
}

void V4l2Camera::fail(CameraState state, const std::string& sentence) {
  send(watch_.failed(clock_.now(), state, sentence));
}

// Until the session is of no more use.
void V4l2Camera::stream() {
  while (!stopping_ && session_) {
    take_new_limit();
    short happened = 0;
    if (wait(POLLIN | POLLPRI, watch_.stall_deadline(), happened)) continue;
    const HostTime now = clock_.now();
    if (happened & POLLPRI) take_events();
    const bool none_came = (happened & (POLLIN | POLLERR | POLLHUP)) != 0 && take_frames() == 0;
    if (session_ && none_came && (happened & POLLERR) != 0) fail_to_read(EIO);
    if (!session_) return;
    if (session_->buffers().all_lent()) watch_.excused(now);
    const std::optional<CameraReport> stalled = watch_.tick(now);
    if (stalled) account_.restarted();  // what was not taken leaves no gap in the device's numbers
    send(stalled);
    if (watch_.is_lost(now)) return;
  }
}

int V4l2Camera::milliseconds_until(HostTime deadline) const {
  const auto left = std::chrono::ceil<milliseconds>(deadline - clock_.now()).count();
  return static_cast<int>(std::clamp<std::int64_t>(left, 0, 60'000));
}

// True if only woken by stop() or limit_exposure().
bool V4l2Camera::wait(short events, HostTime deadline, short& happened) {
  pollfd fds[2] = {{wake_fd_, POLLIN, 0}, {session_ ? session_->device().fd() : -1, events, 0}};
  ::poll(fds, 2, milliseconds_until(deadline));
  if (fds[0].revents != 0) lower(wake_fd_);
  happened = fds[1].revents;
  return fds[0].revents != 0 && happened == 0;
}

int V4l2Camera::take_frames() {
  int taken = 0;
  while (!stopping_ && session_ && take_frame()) ++taken;
  return taken;
}

// False when there is none, or the device failed.
bool V4l2Camera::take_frame() {
  V4l2Slot filled(session_->device());
  const int error = session_->dequeue(filled);
  if (error == 0) {
    hand_out(filled, clock_.now());
    return true;
  }
  if (error != EAGAIN) fail_to_read(error);
  return false;
}

void V4l2Camera::fail_to_read(int error) {
  fail(state_of(error), "Camera '" + path_ + "' failed while streaming (" +
                            sentence_of(path_, "read", error) + ") It is opened anew.");
  session_.reset();
}

void V4l2Camera::hand_out(const V4l2Slot& filled, HostTime arrival) {
  const ExposureTiming timing = session_->timing_of(filled, arrival);
  std::shared_ptr<const RawImage> image = session_->buffers().lend(filled, session_->layout());
  if (account_.is_late(filled.sequence())) return;
  const bool sound = (filled.flags() & V4L2_BUF_FLAG_ERROR) == 0 && check_layout(*image).ok();
  if (!sound) {
    watch_.damaged_frame();
    send(FramesLost{arrival, account_.damaged(filled.sequence(), timing.first_row_start)});
    return;
  }
  const FrameAccount::Counted counted = account_.frame(filled.sequence(), timing.first_row_start);
  send(watch_.frame(arrival));
  if (counted.lost_before > 0) send(FramesLost{arrival, counted.lost_before});
  Frame frame;
  frame.sequence = counted.sequence;
  frame.interior_number = interior_number_;
  frame.timing = timing;
  frame.image = std::move(image);
  send(std::move(frame));
}

void V4l2Camera::take_events() {
  bool lens_moved = false;
  const bool changed = session_->picture_changed(lens_moved);
  if (lens_moved) {
    ++interior_number_;
    interior_ = session_->interior();
    send(CameraNotice{clock_.now(), "The lens of camera '" + path_ +
                                        "' was moved: from here on it is another camera."});
  }
  if (changed) session_.reset();
}

void V4l2Camera::take_new_limit() {
  const std::int64_t limit_us = new_limit_us_.exchange(-1);
  if (limit_us < 0) return;
  options_.longest_exposure = std::chrono::microseconds(limit_us);
  if (session_) session_->limit_exposure(options_.longest_exposure, clock_.now());
}

void V4l2Camera::send(std::optional<CameraReport> report) {
  if (report) sink_(std::move(*report));
}

}  // namespace plumbline
