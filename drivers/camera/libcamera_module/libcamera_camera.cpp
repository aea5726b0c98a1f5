// SPDX-License-Identifier: MIT
#include "drivers/camera/libcamera_module/libcamera_camera.h"

#include <time.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace plumbline {
namespace {

using std::chrono::nanoseconds;

HostTime boot_now() {
  timespec now{};
  ::clock_gettime(CLOCK_BOOTTIME, &now);
  return HostTime(std::chrono::seconds(now.tv_sec) + nanoseconds(now.tv_nsec));
}

// SensorTimestamp is CLOCK_BOOTTIME by its description and CLOCK_MONOTONIC in practice. They differ
// by the time that the machine has slept: the one that puts the frame just before now is meant.
HostTime host_time_of(std::int64_t stamp_ns, HostTime now) {
  const HostTime stamp{nanoseconds(stamp_ns)};
  const nanoseconds asleep = boot_now() - now;
  const bool recent = std::chrono::abs(now - stamp) <= std::chrono::abs(now - (stamp - asleep));
  return recent ? stamp : stamp - asleep;
}

// A lens that is not told to move still reports with noise in the last digits.
constexpr double kLensMovedDioptre = 0.02;

RawColour raw_colour_of(const libcamera::ControlList& metadata) {
  RawColour colour;
  if (const auto levels = metadata.get(libcamera::controls::SensorBlackLevels)) {
    std::array<double, 4>& black = colour.black.emplace();
    for (std::size_t i = 0; i < 4; ++i) black[i] = (*levels)[i] / 65536.0;  // of 16 bits
  }
  const auto gains = metadata.get(libcamera::controls::ColourGains);
  if (gains && (*gains)[0] > 0 && (*gains)[1] > 0) {
    colour.gains = {static_cast<double>((*gains)[0]), static_cast<double>((*gains)[1])};
  }
  return colour;
}

bool same_mode(const RawImage& a, const RawImage& b) {
  return a.width_px == b.width_px && a.height_px == b.height_px && a.format == b.format;
}

}  // namespace

libcamera::CameraManager& camera_manager() {
  static auto* const manager = [] {
    auto* made = new libcamera::CameraManager();  // never deleted: lent frames may outlive main()
    made->start();
    return made;
  }();
  return *manager;
}

LibcameraCamera::LibcameraCamera(std::string id, const Clock& clock)
    : id_(std::move(id)),
      clock_(clock),
      mailbox_(std::make_shared<Mailbox>()),
      watch_("'" + id_ + "'") {}

LibcameraCamera::~LibcameraCamera() { stop(); }

Status LibcameraCamera::start(const CameraOptions& options, Sink sink) {
  if (thread_.joinable()) {
    return Error{"Camera '" + id_ + "' is already running; stop it before starting it anew."};
  }
  options_ = options;
  mailbox_->stopping = false;
  LibcameraFailure failure;
  std::unique_ptr<LibcameraSession> session = open(failure);
  if (!session && !failure.waiting_helps) return Error{failure.sentence};
  sink_ = std::move(sink);
  watch_ = CameraWatch("'" + id_ + "'");
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

void LibcameraCamera::stop() {
  if (!thread_.joinable()) return;
  {
    const std::lock_guard lock(mailbox_->mutex);
    mailbox_->stopping = true;
  }
  mailbox_->changed.notify_all();
  thread_.join();
  sink_ = nullptr;
}

void LibcameraCamera::limit_exposure(std::chrono::microseconds longest) {
  {
    const std::lock_guard lock(mailbox_->mutex);
    mailbox_->new_limit = longest;
  }
  mailbox_->changed.notify_all();
}

Result<CameraDescription> LibcameraCamera::describe() {
  const std::shared_ptr<libcamera::Camera> camera = camera_manager().get(id_);
  if (!camera) {
    return Error{"There is no libcamera camera '" + id_ +
                 "'; plug it in, or look which there are with plumbline camera."};
  }
  CameraDescription description{id_, model_of(*camera), "libcamera", {}, {}};
  description.modes = modes_of(*camera);
  description.controls = describe_controls(camera->controls());
  return description;
}

LibcameraSession::Callbacks LibcameraCamera::callbacks_of(std::uint64_t session) {
  const std::shared_ptr<Mailbox> mailbox = mailbox_;
  const auto completed = [mailbox, session](libcamera::Request* request) {
    {
      const std::lock_guard lock(mailbox->mutex);
      if (mailbox->session != session) return;
      mailbox->completed.push_back(request);
    }
    mailbox->changed.notify_all();
  };
  const auto disconnected = [mailbox, session] {
    {
      const std::lock_guard lock(mailbox->mutex);
      mailbox->disconnected = mailbox->disconnected || mailbox->session == session;
    }
    mailbox->changed.notify_all();
  };
  return {completed, disconnected};
}

std::unique_ptr<LibcameraSession> LibcameraCamera::open(LibcameraFailure& failure) {
  const std::shared_ptr<libcamera::Camera> camera = camera_manager().get(id_);
  if (!camera) {
    failure = {CameraState::kAbsent, true,
               "There is no libcamera camera '" + id_ +
                   "'; plug it in, or look which there are with plumbline camera."};
    return nullptr;
  }
  std::uint64_t session = 0;
  {
    const std::lock_guard lock(mailbox_->mutex);
    session = ++mailbox_->session;
    mailbox_->completed.clear();
    mailbox_->given_back.clear();
    mailbox_->lent = 0;
    mailbox_->disconnected = false;
  }
  return LibcameraSession::open(camera, options_, lens_position_, callbacks_of(session), failure);
}

void LibcameraCamera::run() {
  while (true) {
    if (session_) {
      stream();
      close();
    }
    if (wait_until(clock_.now() + watch_.next_retry())) return;
    LibcameraFailure failure;
    std::unique_ptr<LibcameraSession> session = open(failure);
    if (session) {
      adopt(std::move(session));
    } else {
      fail(failure.state, failure.sentence);
    }
  }
}

void LibcameraCamera::adopt(std::unique_ptr<LibcameraSession> session) {
  session_ = std::move(session);
  session_failed_ = false;
  if (mode_ && !same_mode(*mode_, session_->layout())) ++interior_number_;
  mode_ = session_->layout();
  last_stamp_.reset();
  const HostTime now = clock_.now();
  for (const std::string& notice : session_->notices()) {
    if (std::find(said_.begin(), said_.end(), notice) != said_.end()) continue;
    said_.push_back(notice);
    send(CameraNotice{now, notice});
  }
  if (options_.frames_per_s) {
    account_.set_period(nanoseconds(std::llround(1e9 / *options_.frames_per_s)));
  }
  account_.restarted();
  send(watch_.starting(now, account_.period()));
}

void LibcameraCamera::close() {
  {
    const std::lock_guard lock(mailbox_->mutex);
    ++mailbox_->session;
  }
  session_.reset();
}

void LibcameraCamera::stream() {
  while (!session_failed_) {
    if (wait_until(watch_.stall_deadline())) return;
    const bool all_lent = take_letters();
    const HostTime now = clock_.now();
    if (all_lent) watch_.excused(now);
    judge_silence(now);
    if (watch_.is_lost(now)) return;
  }
}

// What was not taken leaves no gap in the device's numbers, and its time is no period.
void LibcameraCamera::judge_silence(HostTime now) {
  const std::optional<CameraReport> stalled = watch_.tick(now);
  if (!stalled) return;
  account_.restarted();
  last_stamp_.reset();
  send(stalled);
}

// Until there is a letter, or the deadline. True: to be stopped.
bool LibcameraCamera::wait_until(HostTime deadline) {
  std::unique_lock lock(mailbox_->mutex);
  const auto steady = std::chrono::steady_clock::time_point(
      std::chrono::duration_cast<std::chrono::steady_clock::duration>(deadline.time_since_epoch()));
  const bool streaming = session_ != nullptr;
  mailbox_->changed.wait_until(lock, steady, [this, streaming] {
    const bool letters = !mailbox_->completed.empty() || !mailbox_->given_back.empty() ||
                         mailbox_->disconnected || mailbox_->new_limit;
    return mailbox_->stopping || (streaming && letters);
  });
  return mailbox_->stopping;
}

// True when all buffers are lent.
bool LibcameraCamera::take_letters() {
  std::deque<libcamera::Request*> completed;
  std::deque<libcamera::Request*> given_back;
  std::optional<std::chrono::microseconds> limit;
  bool disconnected = false;
  {
    const std::lock_guard lock(mailbox_->mutex);
    completed.swap(mailbox_->completed);
    given_back.swap(mailbox_->given_back);
    limit.swap(mailbox_->new_limit);
    disconnected = mailbox_->disconnected;
  }
  if (disconnected) {
    fail(CameraState::kAbsent, "Camera '" + id_ + "' was unplugged; plug it in again.");
    session_failed_ = true;
    return false;
  }
  if (limit) {
    options_.longest_exposure = *limit;
    session_->limit_exposure(*limit, clock_.now());
  }
  for (libcamera::Request* request : given_back) requeue(request);
  for (libcamera::Request* request : completed) hand_out(request);
  const std::lock_guard lock(mailbox_->mutex);
  return mailbox_->lent >= session_->buffer_count();
}

void LibcameraCamera::requeue(libcamera::Request* request) {
  request->reuse(libcamera::Request::ReuseBuffers);
  if (session_failed_ || session_->queue(request)) return;
  fail(CameraState::kFailing,
       "Camera '" + id_ + "' takes no more requests for frames. It is opened anew.");
  session_failed_ = true;
}

void LibcameraCamera::hand_out(libcamera::Request* request) {
  const libcamera::FrameBuffer* buffer = session_->buffer_of(*request);
  const libcamera::FrameMetadata& taken = buffer->metadata();
  const bool cancelled = request->status() == libcamera::Request::RequestCancelled;
  if (cancelled || account_.is_late(taken.sequence)) {
    requeue(request);
    return;
  }
  const HostTime now = clock_.now();
  const auto sensor_ns = request->metadata().get(libcamera::controls::SensorTimestamp);
  const HostTime stamp =
      host_time_of(sensor_ns.value_or(static_cast<std::int64_t>(taken.timestamp)), now);
  const ExposureTiming timing = timing_of(*request, stamp);
  const auto bytes = session_->memory()->bytes_of(*buffer);
  RawImage image = session_->layout();
  image.bytes = bytes;
  const bool sound =
      taken.status == libcamera::FrameMetadata::FrameSuccess && check_layout(image).ok();
  if (!sound) {
    watch_.damaged_frame();
    send(FramesLost{now, account_.damaged(taken.sequence, stamp)});
    requeue(request);
    return;
  }
  note_lens(request->metadata());
  const FrameAccount::Counted counted = account_.frame(taken.sequence, stamp);
  send(watch_.frame(now));
  if (counted.lost_before > 0) send(FramesLost{now, counted.lost_before});
  Frame frame;
  frame.sequence = counted.sequence;
  frame.interior_number = interior_number_;
  frame.timing = timing;
  if (const auto gain = request->metadata().get(libcamera::controls::AnalogueGain)) {
    frame.gain = static_cast<double>(*gain);
  }
  frame.lens_position_dioptre = lens_position_;
  if (bayer_of(image.format)) frame.colour = raw_colour_of(request->metadata());
  frame.image = lend(request, bytes);
  send(std::move(frame));
}

std::shared_ptr<const RawImage> LibcameraCamera::lend(libcamera::Request* request,
                                                      std::span<const std::uint8_t> bytes) {
  struct Lent {
    RawImage image;
    std::shared_ptr<MappedBuffers> memory;
    std::shared_ptr<Mailbox> mailbox;
    std::uint64_t session;
    libcamera::Request* request;

    ~Lent() {
      const std::lock_guard lock(mailbox->mutex);
      if (mailbox->session != session) return;
      --mailbox->lent;
      mailbox->given_back.push_back(request);
      mailbox->changed.notify_all();
    }
  };
  const std::lock_guard lock(mailbox_->mutex);
  ++mailbox_->lent;
  std::shared_ptr<Lent> lent(
      new Lent{session_->layout(), session_->memory(), mailbox_, mailbox_->session, request});
  lent->image.bytes = bytes;
  return {lent, &lent->image};
}

// Pipelines that run an exposure algorithm say for each frame how long it was exposed, and stamp
// the start of readout; the others (USB cameras) pass on the kernel's stamp of the first packet.
ExposureTiming LibcameraCamera::timing_of(libcamera::Request& request, HostTime stamp) {
  const libcamera::ControlList& metadata = request.metadata();
  const unsigned sequence = session_->buffer_of(request)->metadata().sequence;
  if (const auto us = metadata.get(libcamera::controls::FrameDuration)) {
    account_.set_period(std::chrono::microseconds(*us));
  } else if (last_stamp_ && sequence > last_sequence_ && stamp > *last_stamp_) {
    learn_period((stamp - *last_stamp_) / (sequence - last_sequence_));
  }
  last_stamp_ = stamp;
  last_sequence_ = sequence;
  ExposureModel model{StampMeaning::kFirstPacket, account_.period(),
                      session_->exposures().of_frame(stamp, account_.period()), options_.row_time,
                      session_->layout().height_px};
  if (const auto us = metadata.get(libcamera::controls::ExposureTime)) {
    model.meaning = StampMeaning::kStartOfReadout;
    model.exposure = {std::chrono::microseconds(*us), {}};
  }
  const auto skew_ns = compat::rolling_shutter_skew_ns(metadata);
  if (!model.row_time && skew_ns && model.rows > 1) {
    model.row_time = nanoseconds(*skew_ns / (model.rows - 1));
  }
  return exposure_of(stamp, model);
}

// By the last frames, also those from before an outage: one interval alone is as wrong as the
// stamps at its ends, and what is lost in an outage is counted by it.
void LibcameraCamera::learn_period(nanoseconds interval) {
  constexpr int kFrames = 30;
  intervals_ = std::min(intervals_ + 1, kFrames);
  const nanoseconds before = account_.period();
  account_.set_period(before + (interval - before) / intervals_);
}

void LibcameraCamera::note_lens(const libcamera::ControlList& metadata) {
  const auto position = metadata.get(libcamera::controls::LensPosition);
  if (!position) return;
  const auto now_at = static_cast<double>(*position);
  if (lens_position_ && std::abs(now_at - *lens_position_) < kLensMovedDioptre) return;
  if (lens_position_) {
    ++interior_number_;
    send(CameraNotice{clock_.now(), "The lens of camera '" + id_ +
                                        "' was moved: from here on it is another camera."});
  }
  lens_position_ = now_at;
}

void LibcameraCamera::fail(CameraState state, const std::string& sentence) {
  send(watch_.failed(clock_.now(), state, sentence));
}

void LibcameraCamera::send(std::optional<CameraReport> report) {
  if (report) sink_(std::move(*report));
}

}  // namespace plumbline
