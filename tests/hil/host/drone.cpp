// SPDX-License-Identifier: MIT
#include "tests/hil/host/drone.h"

#include <cmath>

#include "sim/profile.h"

namespace plumbline::hil {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr int kThreads = 2;
constexpr double kNeverS = 1e9;
// Epochs are made before their time.
constexpr std::chrono::seconds kUntilTakeOff(2);

sim::Profile profile_of(const DroneOptions& options) {
  sim::Profile profile = sim::with_width(*sim::named_profile(options.profile), options.width_px);
  if (options.from_m) profile.from_m = *options.from_m;
  if (options.to_m) {
    profile.to_m = *options.to_m;
    profile.side_steps_m.clear();
  }
  return profile;
}

}  // namespace

Result<sim::BenchFlight> flight_of(const DroneOptions& options) {
  if (!sim::named_profile(options.profile)) {
    return Error{"There is no profile '" + options.profile + "': write paper, standard or ice."};
  }
  return sim::BenchFlight::make(profile_of(options), options.seed, kThreads);
}

UvcMode mode_of(const sim::BenchFlight& flight, const DroneOptions& options) {
  const geometry::Camera& camera = flight.calibrated_camera();
  return {camera.width_px, camera.height_px, options.frames_per_s};
}

std::vector<double> heights_m_of(const DroneOptions& options) {
  return sim::climb_heights_m(profile_of(options));
}

Drone::Drone(const sim::BenchFlight& flight, const DroneOptions& options)
    : flight_(flight), options_(options), mode_(mode_of(flight, options)), took_off_s_(kNeverS) {
  if (!options.by_pulse) view_ = std::make_unique<FlightView>(flight, heights_m_of(options), mode_);
  const auto path = [this](double s) { return flight_.antenna_at(s - took_off_s_); };
  stream_ = std::make_shared<sim::GnssStream>(path, receiver_options(), options.seed);
}

// The receiver's own latency is what a configuration that does not know it takes for granted; what
// the virtual machine adds, it has to find out.
sim::GnssStreamOptions Drone::receiver_options() const {
  sim::GnssStreamOptions options;
  options.llh = true;
  options.fixed_sigma = profile_of(options_).gnss_error.white;
  options.host_at_start = HostTime(made_.time_since_epoch());
  options.utc_at_start = std::chrono::floor<std::chrono::seconds>(std::chrono::system_clock::now());
  return options;
}

bool Drone::board(const std::string& sockets) {
  leave();
  const bool eyes =
      options_.by_pulse ? lines_.open(sockets + "/lines", made_) : link_.open(sockets + "/camera");
  if (!plug_receiver(sockets) || !eyes) return false;
  if (options_.by_pulse) return true;
  camera_ = std::thread([this] {
    UvcCamera(
        link_, mode_, [this](const UvcExposure& exposure) { return view_->expose(exposure); },
        camera_orders_)
        .run();
  });
  return true;
}

bool Drone::plug_receiver(const std::string& sockets) {
  posix::Descriptor port = connect_patiently(sockets + "/gnss");
  if (!port.is_open()) return false;
  receiver_ = std::make_unique<ReceiverPort>(
      std::move(port), [stream = stream_] { return std::optional(stream->next()); });
  return true;
}

void Drone::leave() {
  receiver_.reset();
  lines_.close();
  if (camera_.joinable()) camera_.join();
  link_ = RedirLink();
}

Drone::SteadyTime Drone::take_off() {
  const SteadyTime at = mode_.moment_after(SteadyClock::now() + kUntilTakeOff);
  took_off_s_ = std::chrono::duration<double>(at - made_).count();
  if (view_) view_->begin(at);
  return at;
}

double Drone::seconds(SteadyTime now) const {
  return std::chrono::duration<double>(now - made_).count() - took_off_s_;
}

double Drone::height_m(SteadyTime now) const { return flight_.pose_at(seconds(now)).centre_m.z(); }

}  // namespace plumbline::hil
