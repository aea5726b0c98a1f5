// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <string>
#include <vector>

#include "drivers/camera.h"

namespace plumbline::flight {

// Makes JPEGs of frames, in order. Frames wait here with their buffers, of which a camera has few.
class PhotoEncoder {
 public:
  // Called by whoever works: the file, or why there is none.
  using Done = std::function<void(Result<std::vector<std::uint8_t>> jpeg)>;

  explicit PhotoEncoder(int quality) : quality_(quality) {}

  // From any thread.
  void add(Frame frame, Done done);

  // The working thread's: one photo. True if there was one.
  bool work();

 private:
  struct Waiting {
    Frame frame;
    Done done;
  };

  int quality_;
  std::mutex mutex_;
  std::deque<Waiting> waiting_;
};

}  // namespace plumbline::flight
