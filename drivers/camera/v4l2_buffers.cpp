// SPDX-License-Identifier: MIT
#include "drivers/camera/v4l2_buffers.h"

#include <sys/mman.h>

#include <algorithm>
#include <cerrno>
#include <utility>

namespace plumbline {
namespace {

// What a holder of a frame holds.
struct Lent {
  std::shared_ptr<V4l2Buffers> buffers;
  std::uint32_t index;
  RawImage image;

  Lent(std::shared_ptr<V4l2Buffers> from, std::uint32_t at, const RawImage& pixels)
      : buffers(std::move(from)), index(at), image(pixels) {}
  ~Lent() { buffers->give_back(index); }
  Lent(const Lent&) = delete;
  Lent& operator=(const Lent&) = delete;
};

int request(const V4l2Device& device, unsigned& count) {
  v4l2_requestbuffers wanted{};
  wanted.count = count;
  wanted.type = device.capture_type();
  wanted.memory = V4L2_MEMORY_MMAP;
  const int error = device.call(VIDIOC_REQBUFS, &wanted);
  count = wanted.count;
  return error;
}

}  // namespace

int V4l2Buffers::make(const V4l2Device& device, unsigned count, std::shared_ptr<V4l2Buffers>& out) {
  if (const int error = request(device, count); error != 0) return error;
  std::shared_ptr<V4l2Buffers> buffers(new V4l2Buffers(device));
  for (std::uint32_t i = 0; i < count; ++i) {
    int error = buffers->map(i);
    if (error == 0) error = buffers->queue(i);
    if (error != 0) {
      buffers->detach();
      return error;
    }
  }
  out = std::move(buffers);
  return 0;
}

V4l2Buffers::~V4l2Buffers() {
  for (const Mapping& mapping : mappings_) ::munmap(mapping.start, mapping.length);
}

int V4l2Buffers::map(std::uint32_t index) {
  V4l2Slot slot(*device_, index);
  if (const int error = device_->call(VIDIOC_QUERYBUF, slot.argument()); error != 0) return error;
  const std::size_t length = slot.map_bytes();
  void* start = ::mmap(nullptr, length, PROT_READ, MAP_SHARED, device_->fd(),
                       static_cast<off_t>(slot.map_offset()));
  if (start == MAP_FAILED) return errno;
  mappings_.push_back({start, length});
  return 0;
}

int V4l2Buffers::queue(std::uint32_t index) {
  V4l2Slot slot(*device_, index);
  const int error = device_->call(VIDIOC_QBUF, slot.argument());
  if (error == 0) ++queued_;
  return error;
}

std::shared_ptr<const RawImage> V4l2Buffers::lend(const V4l2Slot& filled, RawImage image) {
  const std::uint32_t index = filled.index();
  {
    const std::lock_guard lock(mutex_);
    --queued_;
    const Mapping& mapping = mappings_[index];
    const std::size_t end = std::min(filled.frame_end(), mapping.length);
    const std::size_t begin = std::min(filled.frame_begin(), end);
    image.bytes = {static_cast<const std::uint8_t*>(mapping.start) + begin, end - begin};
  }
  const auto lent = std::make_shared<Lent>(shared_from_this(), index, image);
  return {lent, &lent->image};
}

void V4l2Buffers::give_back(std::uint32_t index) {
  const std::lock_guard lock(mutex_);
  if (device_ == nullptr) return;
  queue(index);  // an error shows itself at the next dequeue
}

bool V4l2Buffers::all_lent() const {
  const std::lock_guard lock(mutex_);
  return queued_ == 0;
}

void V4l2Buffers::detach() {
  const std::lock_guard lock(mutex_);
  if (device_ == nullptr) return;
  std::uint32_t type = device_->capture_type();
  device_->call(VIDIOC_STREAMOFF, &type);
  unsigned none = 0;
  request(*device_, none);  // mappings that are still in use live on without the device
  device_ = nullptr;
}

}  // namespace plumbline
