// SPDX-License-Identifier: MIT
#include "tests/hil/host/flight_view.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "tests/hil/host/uvc_frame.h"

namespace plumbline::hil {
namespace {

constexpr double kNearM = 1.3;       // to a height: 0.6 s at 2 m/s, and gusts
constexpr double kBesideM = 2.5;     // from the axis of the climb: the way aside
constexpr double kBelowTopM = 2.5;   // the way aside is flown no lower
constexpr double kLeastHeightM = 2;  // of which BenchFlight paints a picture

double seconds_of(int moment, const UvcMode& mode) {
  return moment * std::chrono::duration<double>(mode.interval()).count();
}

}  // namespace

std::vector<int> moments_to_show(const sim::BenchFlight& flight,
                                 const std::vector<double>& heights_m, const UvcMode& mode) {
  std::vector<int> moments;
  double top_m = 0;
  for (int k = 0; seconds_of(k, mode) < flight.duration_s(); ++k) {
    const Eigen::Vector3d at_m = flight.pose_at(seconds_of(k, mode)).centre_m;
    const double up_m = at_m.z();
    const bool climbs = up_m > top_m - kNearM;
    top_m = std::max(top_m, up_m);
    const bool near = std::any_of(heights_m.begin(), heights_m.end(), [&](double height_m) {
      return std::abs(up_m - height_m) < kNearM;
    });
    const bool aside = at_m.head<2>().norm() > kBesideM && up_m > top_m - kBelowTopM;
    if ((climbs && near) || aside) moments.push_back(k);
  }
  return moments;
}

FlightView::FlightView(const sim::BenchFlight& flight, const std::vector<double>& heights_m,
                       const UvcMode& mode)
    : flight_(flight),
      mode_(mode),
      ground_{mode.width_px, mode.height_px, 1, {}},
      moments_(moments_to_show(flight, heights_m, mode)),
      pictures_(moments_.size()) {
  ground_.data.assign(
      static_cast<std::size_t>(mode.width_px) * static_cast<std::size_t>(mode.height_px), 128);
  maker_ = std::thread([this] { make_all(); });
}

FlightView::~FlightView() {
  stopping_ = true;
  maker_.join();
}

void FlightView::make_all() {
  for (std::size_t i = 0; i < moments_.size() && !stopping_; ++i) {
    pictures_[i] = grey_of(flight_.photograph(seconds_of(moments_[i], mode_)));
    made_ = static_cast<int>(i) + 1;
  }
}

std::string FlightView::expose(const UvcExposure& exposure) const {
  const std::int64_t begun_ns = begun_ns_;
  const std::int64_t since_ns = exposure.middle.time_since_epoch().count() - begun_ns;
  const double seconds = 1e-9 * static_cast<double>(since_ns);
  if (begun_ns == 0 || made_ == 0) return uvc_frame(ground_, 1, exposure);
  const double height_m = flight_.pose_at(seconds).centre_m.z();
  if (height_m < kLeastHeightM) return uvc_frame(ground_, 1, exposure);
  const auto moment = static_cast<int>(std::lround(seconds / seconds_of(1, mode_)));
  const auto nearer = [&](int a, int b) { return std::abs(a - moment) < std::abs(b - moment); };
  const auto nearest = std::min_element(moments_.begin(), moments_.begin() + made_, nearer);
  const double there_m = flight_.pose_at(seconds_of(*nearest, mode_)).centre_m.z();
  const double enlarged = *nearest == moment ? 1 : there_m / height_m;
  return uvc_frame(pictures_[static_cast<std::size_t>(nearest - moments_.begin())], enlarged,
                   exposure);
}

}  // namespace plumbline::hil
