// SPDX-License-Identifier: MIT
#include "drivers/gpio/edge_numbering.h"

namespace plumbline::gpio {

std::vector<LineEvent> EdgeNumbering::number(const std::vector<RawEdge>& edges) {
  std::vector<LineEvent> events;
  for (const RawEdge& edge : edges) {
    if (const std::uint64_t lost = lost_before(edge); lost > 0) {
      events.emplace_back(EdgesLost{edge.time, lost});
      next_ += lost;
    }
    events.emplace_back(LineEdge{edge.time, edge.rising, next_++});
    last_ = edge;
  }
  return events;
}

std::uint64_t EdgeNumbering::lost_before(const RawEdge& edge) const {
  if (!last_) return 0;
  if (edge.sequence && last_->sequence) {
    const std::uint64_t expected = *last_->sequence + 1;
    return *edge.sequence > expected ? *edge.sequence - expected : 0;
  }
  return last_->rising == edge.rising ? 1 : 0;
}

}  // namespace plumbline::gpio
