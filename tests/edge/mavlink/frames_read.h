// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "edge/mavlink/frame_reader.h"

namespace plumbline::mavlink {

struct FramesRead {
  std::vector<Frame> frames;
  PilotCounters counters;
};

// In pieces of `piece` bytes, and flushed after the last.
FramesRead read_frames(std::string_view bytes, std::size_t piece = 1000000);

bool same(const Frame& a, const Frame& b);
bool same(const std::vector<Frame>& a, const std::vector<Frame>& b);

// Every frame of tests/edge/mavlink/reference_frames.h that a vehicle sends: eight that are read,
// and one that is not.
std::string sample_stream();

}  // namespace plumbline::mavlink
