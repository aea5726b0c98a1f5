// SPDX-License-Identifier: MIT
#include "tests/edge/mavlink/frames_read.h"

#include <algorithm>

#include "tests/edge/mavlink/reference_frames.h"
#include "tests/talk/pilot_talk.h"

namespace plumbline::mavlink {

FramesRead read_frames(std::string_view bytes, std::size_t piece) {
  FramesRead read;
  FrameReader reader([&](const Frame& frame) { read.frames.push_back(frame); });
  for (; !bytes.empty(); bytes.remove_prefix(std::min(piece, bytes.size()))) {
    reader.feed(bytes.substr(0, piece));
  }
  reader.flush();
  read.counters = reader.counters();
  return read;
}

bool same(const Frame& a, const Frame& b) {
  return a.version == b.version && a.sequence == b.sequence && a.system_id == b.system_id &&
         a.component_id == b.component_id && a.id == b.id && a.payload == b.payload;
}

bool same(const std::vector<Frame>& a, const std::vector<Frame>& b) {
  return std::equal(a.begin(), a.end(), b.begin(), b.end(),
                    [](const Frame& x, const Frame& y) { return same(x, y); });
}

std::string sample_stream() {
  std::string stream;
  for (const char* hex :
       {reference::kHeartbeat, reference::kAttitude, reference::kPosition, reference::kSystemTime,
        reference::kPositionCut, reference::kHeartbeatSigned, reference::kHeartbeatV1,
        reference::kAttitudeV1, reference::kPositionV1}) {
    stream += talk::from_hex(hex);
  }
  return stream;
}

}  // namespace plumbline::mavlink
