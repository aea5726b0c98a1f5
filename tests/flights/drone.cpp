// SPDX-License-Identifier: MIT
#include "tests/flights/drone.h"

#include <cmath>
#include <utility>

#include "edge/gnss/stream_decoder.h"

namespace plumbline::flights {

Drone::Drone(const DroneOptions& options)
    : path_(options.path, options.seed),
      frame_(*geodesy::LocalFrame::at({35.66, 139.76, 52.3})),
      clock_(HostTime{},
             std::chrono::time_point_cast<std::chrono::nanoseconds>(options.receiver.utc_at_start)),
      rate_error_(options.receiver.host_rate_error),
      stream_([this](double s) { return frame_.geodetic_of(path_.at(s)); }, options.receiver,
              options.seed),
      receiver_(clock_, gnss::make_fix_decoder, [this] { return next_piece(); }),
      camera_(clock_, options.camera) {
  if (options.cable_out) {
    using Kind = sim::LinePiece::Kind;
    cable_ = {{options.cable_out->first, Kind::kPulled, ""},
              {options.cable_out->second, Kind::kPluggedIn, ""}};
  }
  clock_.run_until(options.switched_on);
}

std::optional<sim::LinePiece> Drone::next_piece() {
  if (!piece_) piece_ = stream_.next();
  if (cable_.empty() || piece_->time < cable_.front().time) return std::exchange(piece_, {});
  const sim::LinePiece change = cable_.front();
  cable_.pop_front();
  return change;
}

Eigen::Vector3d Drone::place_m(HostTime time) const {
  return path_.at(std::chrono::duration<double>(time.time_since_epoch()).count() /
                  (1 + rate_error_));
}

HostTime Drone::end() const {
  return HostTime{} + std::chrono::nanoseconds(std::llround(1e9 * path_.duration_s()));
}

}  // namespace plumbline::flights
