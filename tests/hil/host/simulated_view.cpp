// SPDX-License-Identifier: MIT
#include "tests/hil/host/simulated_view.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "tests/hil/host/exposure_mark.h"

namespace plumbline::hil {
namespace {

constexpr double kBetweenPicturesM = 1;
constexpr double kUsualExposureTimesGain = 20 * 10;

sim::Profile profile_of(const UvcMode& mode) {
  sim::Profile profile = *sim::named_profile("paper");
  profile.focal_length_px *= mode.width_px / static_cast<double>(profile.width_px);
  profile.width_px = mode.width_px;
  profile.height_px = mode.height_px;
  return profile;
}

Image grey_of(const Image& colour) {
  Image grey{colour.width_px, colour.height_px, 1, {}};
  for (std::size_t i = 0; i + 2 < colour.data.size(); i += 3) {
    const int luma = 299 * colour.data[i] + 587 * colour.data[i + 1] + 114 * colour.data[i + 2];
    grey.data.push_back(static_cast<std::uint8_t>(luma / 1000));
  }
  return grey;
}

// Grey at every brightness, bounded by white.
std::array<char, 256> exposed(double brightness) {
  std::array<char, 256> table{};
  for (std::size_t grey = 0; grey < table.size(); ++grey) {
    const double level = std::min(255.0, std::round(brightness * static_cast<double>(grey)));
    table[grey] = static_cast<char>(static_cast<std::uint8_t>(level));
  }
  return table;
}

double brightness_of(const UvcSettings& set) {
  if (set.automatic) return 1;
  return static_cast<double>(set.exposure_100us * set.gain) / kUsualExposureTimesGain;
}

// Which column (or row) of a picture each of an enlarged one shows; 1: as it is.
std::vector<std::size_t> shown(int count, double enlarged) {
  std::vector<std::size_t> indices;
  const double middle = 0.5 * (count - 1);
  for (int i = 0; i < count; ++i) {
    const double from = std::clamp(middle + (i - middle) / enlarged, 0.0, count - 1.0);
    indices.push_back(static_cast<std::size_t>(std::lround(from)));
  }
  return indices;
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
  const auto columns = shown(picture.width_px, enlarged);
  const std::array<char, 256> level = exposed(brightness_of(exposure.set));
  std::string bytes;
  bytes.reserve(2 * picture.data.size());
  for (const std::size_t row : shown(picture.height_px, enlarged)) {
    const std::uint8_t* line = &picture.data[row * static_cast<std::size_t>(picture.width_px)];
    for (const std::size_t column : columns) {
      bytes += level[line[column]];
      bytes += static_cast<char>(128);
    }
  }
  const std::chrono::nanoseconds middle = exposure.middle.time_since_epoch();
  write_exposure_mark(bytes, static_cast<std::uint64_t>(middle.count()));
  return bytes;
}

}  // namespace plumbline::hil
