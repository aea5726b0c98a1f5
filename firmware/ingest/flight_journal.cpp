// SPDX-License-Identifier: MIT
#include "firmware/ingest/flight_journal.h"

#include <algorithm>
#include <charconv>
#include <chrono>
#include <map>
#include <utility>

#include "edge/capture/navigator.h"
#include "edge/gnss/leap_seconds.h"
#include "edge/timing/antenna_predictor.h"
#include "firmware/ingest/text_file.h"

namespace plumbline::ingest {
namespace {

constexpr std::size_t kLargestJournal = std::size_t{1} << 31;

// Plays what was heard up to some time after each exposure: the place is then known from both
// sides. A new run begins with each start of the program.
class Playback {
 public:
  explicit Playback(const capture::CaptureOptions& options) : options_(options) { restart(); }

  void take(const record::Entry& entry) {
    if (std::holds_alternative<record::Began>(entry)) {
      settle(HostTime::max());
      restart();
    } else if (const auto* input = std::get_if<capture::Input>(&entry)) {
      hear(*input);
    } else if (const auto* decision = std::get_if<capture::Decision>(&entry)) {
      if (const auto* taken = std::get_if<capture::PhotoTaken>(&decision->what)) {
        waiting_.push_back(*taken);
      }
    }
  }

  struct Places {
    std::map<int, AntennaAtPhoto> of_photo;
    double latency_sigma_s = 0;
  };

  Places finish() {
    settle(HostTime::max());
    for (auto& [number, at] : places_.of_photo) {
      if (const Latency& latency = latencies_.at(number); latency.sigma_s < places_.latency_sigma_s)
        make_its_own(latency, at);
    }
    return std::move(places_);
  }

 private:
  struct Latency {
    double sigma_s = 0;
    Eigen::Vector3d shift_m = Eigen::Vector3d::Zero();  // of the position, by that
  };

  // So long after an exposure the epochs on both sides have arrived.
  static constexpr std::chrono::seconds kLater{2};

  void restart() {
    capture::NavigatorOptions navigator;
    navigator.clock.latency = options_.receiver_latency;
    navigator_.emplace(navigator);
  }

  void hear(const capture::Input& input) {
    settle(input.now);
    navigator_->hear(input);
  }

  void settle(HostTime now) {
    std::erase_if(waiting_, [&](const capture::PhotoTaken& taken) {
      if (now != HostTime::max() && now < taken.exposed + kLater) return false;
      place(taken);
      return true;
    });
  }

  void place(const capture::PhotoTaken& taken) {
    const auto motion = navigator_->at(taken.exposed);
    const auto frame = navigator_->frame();
    const auto clock = navigator_->clock();
    if (!motion || !frame || !clock || motion->reckoned) return;
    const auto instant = clock->gps_of(taken.exposed);
    const Eigen::Vector3d blur_m =
        motion->velocity_m_s * std::chrono::duration<double>(taken.exposed_sigma).count();
    AntennaAtPhoto at;
    at.position = frame->geodetic_of(motion->in_enu_m);
    const Latency latency{std::chrono::duration<double>(instant.sigma_latency).count(),
                          motion->latency_shift_m};
    at.covariance_enu_m2 = motion->covariance_m2 - latency.shift_m * latency.shift_m.transpose() +
                           blur_m * blur_m.transpose();
    at.velocity_enu_m_s = motion->velocity_m_s;
    at.quality = motion->quality;
    at.utc = gnss::utc_of(instant.time);
    places_.latency_sigma_s = std::max(places_.latency_sigma_s, latency.sigma_s);
    places_.of_photo.insert_or_assign(taken.number, at);
    latencies_.insert_or_assign(taken.number, latency);
  }

  // A photo of which the latency was better known, by pulses that others lacked, does not share
  // their error.
  static void make_its_own(const Latency& latency, AntennaAtPhoto& at) {
    at.covariance_enu_m2 += latency.shift_m * latency.shift_m.transpose();
    at.velocity_enu_m_s.reset();
  }

  capture::CaptureOptions options_;
  std::optional<capture::Navigator> navigator_;
  std::vector<capture::PhotoTaken> waiting_;
  std::map<int, Latency> latencies_;
  Places places_;
};

int number_of(const std::string& photo) {
  int number = 0;
  std::from_chars(photo.data(), photo.data() + photo.size(), number);
  return number;
}

// Host times compare within one run of the program.
class Headings {
 public:
  void take(const record::Entry& entry) {
    if (std::holds_alternative<record::Began>(entry)) finish_run();
    if (const auto* attitude = std::get_if<PilotAttitude>(&entry)) told_.push_back(*attitude);
    if (const auto* decision = std::get_if<capture::Decision>(&entry)) {
      const auto* taken = std::get_if<capture::PhotoTaken>(&decision->what);
      if (taken != nullptr) photos_.push_back(*taken);
    }
  }

  std::map<int, double> finish() {
    finish_run();
    return std::move(yaw_rad_);
  }

 private:
  static constexpr std::chrono::seconds kNear{1};

  void finish_run() {
    for (const capture::PhotoTaken& photo : std::exchange(photos_, {})) {
      const auto off = [&](const PilotAttitude& told) {
        return std::chrono::abs(told.arrival - photo.exposed);
      };
      const auto nearest = std::min_element(
          told_.begin(), told_.end(),
          [&](const PilotAttitude& a, const PilotAttitude& b) { return off(a) < off(b); });
      if (nearest == told_.end() || off(*nearest) > kNear) continue;
      yaw_rad_.insert_or_assign(photo.number, nearest->yaw_rad);
    }
    told_.clear();
  }

  std::vector<PilotAttitude> told_;
  std::vector<capture::PhotoTaken> photos_;
  std::map<int, double> yaw_rad_;
};

}  // namespace

std::optional<std::filesystem::path> journal_of(const std::filesystem::path& flight) {
  std::error_code error;
  const std::filesystem::path path = flight / "flight.journal";
  if (!std::filesystem::is_regular_file(path, error)) return std::nullopt;
  return path;
}

Result<FlightJournal> read_flight_journal(const std::filesystem::path& path) {
  const auto bytes = read_bytes(path, kLargestJournal);
  if (!bytes) return bytes.error();
  auto reader =
      record::JournalReader::over({reinterpret_cast<const char*>(bytes->data()), bytes->size()});
  if (!reader) return Error{path.string() + ": " + reader.error().sentence};
  FlightJournal journal;
  while (auto entry = reader->next()) journal.entries.push_back(std::move(*entry));
  journal.summary = reader->summary();
  return journal;
}

AntennaPositions antenna_of_flight(const FlightJournal& journal,
                                   const std::vector<std::string>& photos,
                                   const capture::CaptureOptions& options) {
  Playback playback(options);
  for (const record::Entry& entry : journal.entries) playback.take(entry);
  const auto [places, latency_sigma_s] = playback.finish();
  AntennaPositions antenna;
  antenna.common_time_sigma_s = latency_sigma_s;
  for (const std::string& photo : photos) {
    const auto place = places.find(number_of(photo));
    if (place == places.end()) {
      antenna.photos.emplace_back();
      antenna.warnings.push_back("Photo " + photo +
                                 " has no position: the receiver gave none around its exposure.");
    } else {
      antenna.photos.emplace_back(place->second);
    }
  }
  return antenna;
}

std::vector<std::optional<double>> headings_of_flight(const FlightJournal& journal,
                                                      const std::vector<std::string>& photos) {
  Headings headings;
  for (const record::Entry& entry : journal.entries) headings.take(entry);
  const auto yaw_rad = headings.finish();
  std::vector<std::optional<double>> found;
  for (const std::string& photo : photos) {
    const auto yaw = yaw_rad.find(number_of(photo));
    found.push_back(yaw == yaw_rad.end() ? std::nullopt : std::optional(yaw->second));
  }
  return found;
}

}  // namespace plumbline::ingest
