// SPDX-License-Identifier: MIT
#include "firmware/commands/sim_flown.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "edge/gnss/stream_decoder.h"
#include "edge/timing/gnss_clock.h"
#include "firmware/config/config_toml.h"
#include "firmware/deliver/photo_writer.h"
#include "firmware/flight/session.h"
#include "firmware/ingest/camera_toml.h"
#include "sim/bench_flight.h"
#include "sim/gnss_stream.h"
#include "sim/random.h"
#include "sim/release_wire.h"
#include "sim/replayed_receiver.h"
#include "sim/sim_camera.h"
#include "sim/sim_disk.h"
#include "sim/virtual_clock.h"

namespace plumbline::commands {
namespace {

using std::chrono::nanoseconds;

constexpr const char* kFolder = "0001";  // of the one flight on the disk
constexpr std::uint64_t kLatencyStream = 0x1A7E;

// The morning of every simulated flight, at a whole second, as a receiver's epochs are.
UtcTime take_off_day() {
  using namespace std::chrono;
  return sys_days{year{2026} / April / 18} + hours{1} + minutes{12} + seconds{3};
}

Status flyable(const sim::Profile& profile) {
  if (!profile.gnss) return Error{"The daemon flies with a receiver: leave gnss = false away."};
  if (profile.fix != sim::Fix::kFixed) {
    return Error{"With --fly the receiver has a fixed solution: leave the other kind of fix away."};
  }
  if (profile.heading) {
    return Error{"With --fly no compass writes into the photos: leave the heading away."};
  }
  if (profile.side_steps_m.size() > 1) {
    return Error{"With --fly the drone goes aside once: give one side-step at most."};
  }
  return Done{};
}

std::string figure(double value) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", value);
  return text;
}

// What the daemon would have been told for such a flight: every side-step has a photo on the way,
// too, so that wind does not cost the only one.
std::string configuration_for(const sim::Profile& profile) {
  std::string heights;
  for (const double height_m : sim::climb_heights_m(profile)) {
    heights += (heights.empty() ? "" : ", ") + figure(height_m);
  }
  const double aside_m = profile.side_steps_m.empty() ? 0 : 0.5 * profile.side_steps_m.front();
  return "# A flight of plumbline sim --fly.\n[camera]\nid = \"simulated\"\n\n[release]\n"
         "by = \"pulse\"\nline = \"simulated\"\n\n[capture]\nheights_m = [" +
         heights + "]\naside_m = " + figure(aside_m) + "\n";
}

// Receivers differ: by as much as a configuration that does not know its own takes for granted.
nanoseconds latency_of_receiver(std::uint64_t seed) {
  const timing::Latency usual;
  const double off_s = in_seconds(usual.sigma) * sim::Random(seed, kLatencyStream).normal();
  return std::clamp(usual.value + from_seconds(off_s), usual.value / 4, usual.value * 2);
}

// The drone, its devices, and the session of the daemon that flies with them.
class Flown {
 public:
  Flown(const FlownFlight& flown, const sim::BenchFlight& flight, config::Config config,
        std::string configuration, const Progress& progress)
      : flown_(flown),
        flight_(flight),
        config_(std::move(config)),
        configuration_(std::move(configuration)),
        progress_(progress),
        clock_(HostTime{}, std::chrono::time_point_cast<nanoseconds>(take_off_day())),
        stream_([this](double s) { return flight_.antenna_at(s); }, receiver_options(), flown.seed),
        receiver_(clock_, gnss::make_fix_decoder, [this] { return stream_.next(); }),
        camera_(clock_, camera_options()),
        wire_(clock_, {.width = nanoseconds{0}, .seed = flown.seed},
              [this](HostTime time) { camera_.release(time); }) {}

  Status fly() {
    flight::Devices devices{clock_, disk_, receiver_, &camera_, &wire_};
    flight::Session session(session_options(), devices, events());
    session_ = &session;
    if (const Status started = session.start(); !started) return started;
    session.run(HostTime{} + from_seconds(flight_.duration_s()));
    if (!ended_) session.finish("The simulation ended.");
    session_ = nullptr;
    if (!taken_.empty()) return Done{};
    return Error{
        "The flight took no photo: let its heights begin higher, where it is known to have taken "
        "off."};
  }

  sim::SimDisk& disk() { return disk_; }
  const std::vector<sim::BenchFlight::Taken>& taken() const { return taken_; }

 private:
  sim::GnssStreamOptions receiver_options() const {
    sim::GnssStreamOptions options;
    options.fixed_sigma = flown_.profile.gnss_error.white;
    options.least_latency = latency_of_receiver(flown_.seed);
    options.utc_at_start = take_off_day();
    return options;
  }

  sim::SimCameraOptions camera_options() {
    sim::SimCameraOptions options;
    options.width_px = flown_.profile.width_px;
    options.height_px = flown_.profile.height_px;
    options.channels = 3;
    options.row_time = {};
    options.sigma_stamp = std::chrono::microseconds(100);
    options.released = true;
    options.seed = static_cast<unsigned>(flown_.seed);
    options.picture = [this](const ExposureTiming& exact) {
      const double middle_s = seconds_of(exact.middle_of_row(0));
      exposures_s_.push_back(middle_s);
      return flight_.photograph(middle_s);
    };
    return options;
  }

  flight::SessionOptions session_options() const {
    flight::SessionOptions options;
    options.capture = config_.capture;
    options.camera = config_.camera.options;
    options.jpeg_quality = flown_.profile.jpeg_quality;
    options.recorder.camera_toml = ingest::camera_toml(flight_.calibrated_camera());
    options.program = "plumbline sim";
    options.configuration = configuration_;
    options.threads = false;
    return options;
  }

  flight::SessionEvents events() {
    flight::SessionEvents events;
    events.decided = [this](const capture::Decision& decision) {
      const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what);
      if (taken != nullptr) keep(*taken);
    };
    events.ended = [this](const std::string& folder) {
      if (folder != kFolder) return;
      ended_ = true;
      session_->stop();
    };
    return events;
  }

  void keep(const capture::PhotoTaken& taken) {
    const double said_s = seconds_of(taken.exposed);
    const auto nearer = [&](double a, double b) {
      return std::abs(a - said_s) < std::abs(b - said_s);
    };
    char name[16];
    std::snprintf(name, sizeof name, "%04d.jpg", taken.number);
    taken_.push_back({name, *std::min_element(exposures_s_.begin(), exposures_s_.end(), nearer)});
    const int done = static_cast<int>(taken_.size());
    const int planned = static_cast<int>(config_.capture.plan.heights_m.size()) +
                        (config_.capture.plan.aside_m ? 2 : 0);
    progress_("flying", done, std::max(done, planned));
  }

  static double seconds_of(HostTime time) { return in_seconds(time.time_since_epoch()); }

  const FlownFlight& flown_;
  const sim::BenchFlight& flight_;
  config::Config config_;
  std::string configuration_;
  const Progress& progress_;
  std::vector<double> exposures_s_;  // middles
  std::vector<sim::BenchFlight::Taken> taken_;
  bool ended_ = false;
  flight::Session* session_ = nullptr;
  sim::SimDisk disk_;
  sim::VirtualClock clock_;
  sim::GnssStream stream_;
  sim::ReplayedReceiver receiver_;
  sim::SimCamera camera_;
  sim::ReleaseWire wire_;
};

// What the session left on its disk, into the folder.
Status copy_recording(sim::SimDisk& disk, const std::filesystem::path& folder) {
  const std::string from = kFolder;
  const auto photos = disk.list(from + "/photos");
  if (!photos) return photos.error();
  std::vector<std::string> names{"flight.journal"};
  for (const std::string& photo : *photos) names.push_back("photos/" + photo);
  for (const std::string& name : names) {
    const auto bytes = disk.read((from + "/").append(name));
    if (!bytes) return bytes.error();
    const Status written = deliver::write_whole_file(folder / name, *bytes);
    if (!written) return written;
  }
  return Done{};
}

Result<SimulatedFolder> fly_into(const FlownFlight& flown, const std::filesystem::path& folder,
                                 const Progress& progress) {
  std::string configuration = configuration_for(flown.profile);
  const auto reading = config::parse_config(configuration, "the configuration of this flight");
  if (!reading.errors.empty()) return reading.errors.front();
  progress("laying the ground", 0, 1);
  const auto flight =
      sim::BenchFlight::make(flown.profile, flown.seed, flown.threads, flown.ground_photo);
  if (!flight) return flight.error();
  progress("laying the ground", 1, 1);
  Flown session(flown, *flight, reading.config, std::move(configuration), progress);
  if (const Status flew = session.fly(); !flew) return flew.error();
  if (const Status copied = copy_recording(session.disk(), folder); !copied) return copied.error();
  const sim::World& world = flight->world();
  const Status written =
      write_truth(world, flight->flown(session.taken()), flight->frame(), folder);
  if (!written) return written.error();
  return SimulatedFolder{static_cast<int>(session.taken().size()),
                         static_cast<int>(world.targets().size())};
}

}  // namespace

Result<SimulatedFolder> write_flown_flight(const FlownFlight& flown,
                                           const std::filesystem::path& folder,
                                           const Progress& progress) {
  if (const Status possible = flyable(flown.profile); !possible) return possible.error();
  return in_new_folder(folder, [&] { return fly_into(flown, folder, progress); });
}

}  // namespace plumbline::commands
