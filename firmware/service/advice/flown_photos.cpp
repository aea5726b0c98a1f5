// SPDX-License-Identifier: MIT
#include "firmware/service/advice/flown_photos.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <charconv>
#include <set>

#include "edge/capture/height_steps.h"
#include "edge/capture/navigator.h"
#include "edge/gnss/antenna_track.h"
#include "edge/record/journal.h"

namespace plumbline::service {
namespace {

constexpr double kThere_m = 0.3;  // a height so near is where the drone is
// Of a variance along the way flown, at the least so much is a photo's own.
constexpr double kOwnShare = 0.05;

int number_of_photo(const std::string& name) {
  int number = 0;
  std::from_chars(name.data(), name.data() + name.size(), number);
  return name.ends_with(".part") ? 0 : number;
}

std::set<int> photos_on_disk(Storage& storage, const std::string& flight) {
  std::set<int> numbers;
  const auto names = storage.list(flight + "/photos");
  if (!names) return numbers;
  for (const std::string& name : *names) numbers.insert(number_of_photo(name));
  numbers.erase(0);
  return numbers;
}

// Plays a journal as far as it takes to know the frame of each run.
class Before {
 public:
  Before(const capture::CaptureOptions& options, std::set<int> stored)
      : options_(options), stored_(std::move(stored)) {}

  void take(const record::Entry& entry) {
    if (std::holds_alternative<record::Began>(entry)) {
      capture::NavigatorOptions options;
      options.clock.latency = options_.receiver_latency;
      navigator_.emplace(options);
    } else if (const auto* input = std::get_if<capture::Input>(&entry)) {
      if (navigator_ && !navigator_->frame()) navigator_->hear(*input);
    } else if (const auto* decision = std::get_if<capture::Decision>(&entry)) {
      const auto* taken = std::get_if<capture::PhotoTaken>(&decision->what);
      if (taken != nullptr) add(*taken);
    }
  }

  std::vector<FlownPhoto> photos() { return std::move(photos_); }

 private:
  void add(const capture::PhotoTaken& taken) {
    if (!navigator_ || (taken.frame && !stored_.contains(taken.number))) return;
    if (auto photo = flown_photo(taken, navigator_->frame())) photos_.push_back(std::move(*photo));
  }

  const capture::CaptureOptions& options_;
  std::set<int> stored_;
  std::optional<capture::Navigator> navigator_;
  std::vector<FlownPhoto> photos_;
};

bool is_positive(const Eigen::Matrix3d& covariance_m2) {
  return covariance_m2.allFinite() &&
         Eigen::LLT<Eigen::Matrix3d>(covariance_m2).info() == Eigen::Success;
}

// What the place of a photo errs by on its own: without what the receiver's latency leaves open,
// which is the same time for all.
plan::PhotoFix fix_of_photo(const FlownPhoto& photo, double latency_sigma_s) {
  plan::PhotoFix fix{photo.covariance_m2, photo.velocity_m_s};
  if (photo.jumped || !is_positive(fix.covariance_m2)) {
    const FixQuality quality = photo.jumped ? FixQuality::kNone : photo.quality;
    fix.covariance_m2 = gnss::usual_sigma_enu_m(quality).cwiseAbs2().asDiagonal().toDenseMatrix();
    return fix;
  }
  const double speed_m_s = photo.velocity_m_s.norm();
  if (!(latency_sigma_s > 0 && speed_m_s > 0)) return fix;
  const Eigen::Vector3d way = photo.velocity_m_s / speed_m_s;
  const double along_m2 = 1 / way.dot(fix.covariance_m2.llt().solve(way));
  const double common_m2 =
      std::min(std::pow(latency_sigma_s * speed_m_s, 2), (1 - kOwnShare) * along_m2);
  fix.covariance_m2 -= common_m2 * way * way.transpose();
  return fix;
}

bool is_fixed(const FlownPhoto& photo) {
  return photo.quality == FixQuality::kFixed && !photo.jumped;
}

}  // namespace

std::optional<FlownPhoto> flown_photo(const capture::PhotoTaken& taken,
                                      const std::optional<geodesy::LocalFrame>& frame) {
  if (!taken.place || !frame) return std::nullopt;
  const capture::Place& place = *taken.place;
  return FlownPhoto{taken.target,       frame->geodetic_of(place.in_enu_m),
                    place.height_m,     place.covariance_m2,
                    place.velocity_m_s, place.quality,
                    taken.marks.jumped};
}

std::vector<FlownPhoto> photos_before(Storage& storage, const std::string& flight,
                                      const capture::CaptureOptions& options) {
  const auto bytes = storage.read(flight + "/flight.journal");
  if (!bytes) return {};
  auto reader = record::JournalReader::over(*bytes);
  if (!reader) return {};
  Before before(options, photos_on_disk(storage, flight));
  while (const auto entry = reader->next()) before.take(*entry);
  return before.photos();
}

std::vector<double> heights_to_come(const capture::CapturePlan& plan,
                                    const std::vector<FlownPhoto>& photos) {
  if (photos.empty() || photos.back().target.reason == capture::Reason::kAside) return {};
  capture::HeightSteps steps(plan);
  bool upwards = plan.direction != capture::Direction::kDown;
  for (const FlownPhoto& photo : photos) {
    const int entry = photo.target.entry;
    if (entry < 0 || static_cast<std::size_t>(entry) >= steps.entries().size()) continue;
    steps.set_taken(entry, true);
    upwards = steps.entries()[static_cast<std::size_t>(entry)].sign > 0;
  }
  const double here_m = photos.back().height_m;
  std::vector<double> up_m, down_m;
  for (const auto& entry : steps.entries()) {
    if (entry.taken) continue;
    const bool is_above = entry.height_m > here_m + kThere_m;
    if (entry.sign > 0 && upwards && is_above) up_m.push_back(entry.height_m);
    const bool is_below = entry.height_m < here_m - kThere_m;
    if (entry.sign < 0 && (upwards || is_below)) down_m.push_back(entry.height_m);
  }
  up_m.insert(up_m.end(), down_m.rbegin(), down_m.rend());
  return up_m;
}

plan::Flight flight_of(const std::vector<FlownPhoto>& photos, const std::vector<double>& to_come_m,
                       double latency_sigma_s) {
  plan::Flight flight;
  if (photos.empty()) return flight;
  const auto frame = geodesy::LocalFrame::at(photos.back().place);
  if (!frame) return flight;
  const bool any_fixed = std::any_of(photos.begin(), photos.end(), is_fixed);
  for (const FlownPhoto& photo : photos) {
    const Eigen::Vector3d place_m = frame->enu_of(photo.place);
    flight.taken_m.emplace_back(place_m.x(), place_m.y(), photo.height_m);
    if (any_fixed) flight.taken_fixes.push_back(fix_of_photo(photo, latency_sigma_s));
  }
  for (const double height_m : to_come_m) flight.ahead_m.emplace_back(0, 0, height_m);
  return flight;
}

int photos_without_fix(const std::vector<FlownPhoto>& photos) {
  return static_cast<int>(photos.size()) -
         static_cast<int>(std::count_if(photos.begin(), photos.end(), is_fixed));
}

}  // namespace plumbline::service
