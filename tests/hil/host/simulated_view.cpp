// SPDX-License-Identifier: MIT
#include "tests/hil/host/simulated_view.h"

#include <algorithm>
#include <cmath>

#include "tests/hil/host/uvc_frame.h"

namespace plumbline::hil {
namespace {

constexpr double kBetweenPicturesM = 1;

sim::Profile profile_of(const UvcMode& mode) {
  sim::Profile profile = sim::with_width(*sim::named_profile("paper"), mode.width_px);
  profile.height_px = mode.height_px;
  return profile;
}

}  // namespace

SimulatedView::SimulatedView(const UvcMode& mode)
    : profile_(profile_of(mode)), flight_(sim::fly(profile_, 1)) {
  for (double up_m = 0; up_m <= profile_.to_m - profile_.from_m; up_m += kBetweenPicturesM) {
    heights_m_.push_back(up_m);
  }
  pictures_.resize(heights_m_.size());
  renderer_ = std::thread([this] { render_all(); });
  while (ready_ == 0) std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

SimulatedView::~SimulatedView() {
  stopping_ = true;
  renderer_.join();
}

void SimulatedView::render_all() {
  const sim::World world(sim::world_for(profile_, 1, 2), std::nullopt);
  for (std::size_t i = 0; i < pictures_.size() && !stopping_; ++i) {
    geometry::Pose pose = flight_.shots.front().pose;
    pose.centre_m.z() += heights_m_[i];
    pictures_[i] =
        grey_of(sim::render(world, flight_.camera, pose, sim::sensor_for(flight_, 0), i, 1));
    ready_ = i + 1;
  }
}

// Above the lowest, up and down.
double SimulatedView::height_m(std::chrono::steady_clock::time_point time) const {
  const double range_m = profile_.to_m - profile_.from_m;
  const double way_m = std::fmod(
      profile_.climb_rate_m_s * std::chrono::duration<double>(time - begin_).count(), 2 * range_m);
  return way_m < range_m ? way_m : 2 * range_m - way_m;
}

std::size_t SimulatedView::nearest_picture(double height_m) const {
  const auto at = static_cast<std::size_t>(std::lround(height_m / kBetweenPicturesM));
  return std::min(at, ready_ - 1);
}

std::string SimulatedView::expose(const UvcExposure& exposure) const {
  const double up_m = height_m(exposure.middle);
  const std::size_t nearest = nearest_picture(up_m);
  const Image& picture = pictures_[nearest];
  const double enlarged = (profile_.from_m + heights_m_[nearest]) / (profile_.from_m + up_m);
  return uvc_frame(picture, enlarged, exposure);
}

}  // namespace plumbline::hil
