// SPDX-License-Identifier: MIT
#pragma once

#include <linux/videodev2.h>

#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <span>
#include <vector>

#include "drivers/camera/v4l2_device.h"
#include "drivers/camera/v4l2_planes.h"
#include "edge/base/raw_image.h"

namespace plumbline {

// The buffers of one stream, mapped into memory. A lent one goes back to the kernel when its last
// holder lets go, from whatever thread; after detach() that only frees it. The mapping lives as
// long as a frame is held.
class V4l2Buffers : public std::enable_shared_from_this<V4l2Buffers> {
 public:
  // Asks for `count` buffers and queues them all; `device` lives until detach(). 0 or errno.
  static int make(const V4l2Device& device, unsigned count, std::shared_ptr<V4l2Buffers>& out);
  ~V4l2Buffers();
  V4l2Buffers(const V4l2Buffers&) = delete;
  V4l2Buffers& operator=(const V4l2Buffers&) = delete;

  // `image` says how the pixels lie; its bytes become those of the frame in the buffer.
  std::shared_ptr<const RawImage> lend(const V4l2Slot& filled, RawImage image);

  void give_back(std::uint32_t index);

  // Whether the kernel has none left to fill.
  bool all_lent() const;

  // Frees the device of them, lent or not: it can be closed and opened anew.
  void detach();

 private:
  struct Mapping {
    void* start = nullptr;
    std::size_t length = 0;
  };

  explicit V4l2Buffers(const V4l2Device& device) : device_(&device) {}
  int map(std::uint32_t index);
  int queue(std::uint32_t index);

  mutable std::mutex mutex_;
  const V4l2Device* device_;  // nullptr: detached
  std::vector<Mapping> mappings_;
  unsigned queued_ = 0;
};

}  // namespace plumbline
