// SPDX-License-Identifier: MIT
#include "firmware/devices_in_sim.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdarg>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <utility>

#include "edge/timing/gnss_clock.h"
#include "firmware/ingest/camera_toml.h"
#include "sim/gnss_stream.h"
#include "sim/random.h"
#include "sim/release_wire.h"
#include "sim/truth.h"

namespace plumbline {
namespace {

namespace fs = std::filesystem;

constexpr int kThreads = 1;      // of the painter: the other core is the daemon's
constexpr int kWidth_px = 1600;  // a frame that one core paints while the drone climbs a step
constexpr double kFramesPerSecond = 0.3;  // of a camera that runs freely, for the same reason
constexpr double kSurface_m = 60;

Status write(const fs::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary | std::ios::trunc);
  file << text;
  file.close();
  if (file.good()) return Done{};
  return Error{"Cannot write " + path.string() + "; is the disk full, or the folder another's?"};
}

// Receivers differ: by as much as a configuration that does not know its own takes for granted.
std::chrono::nanoseconds least_latency(std::uint64_t seed) {
  const timing::Latency usual;
  sim::Random random(seed, 0x1A7E);
  const auto off = std::chrono::duration<double>(usual.sigma) * random.normal();
  return std::clamp(usual.value + std::chrono::duration_cast<std::chrono::nanoseconds>(off),
                    usual.value / 4, usual.value * 2);
}

[[gnu::format(printf, 1, 2)]] std::string text(const char* format, ...) {
  std::array<char, 256> buffer{};
  std::va_list arguments;
  va_start(arguments, format);
  std::vsnprintf(buffer.data(), buffer.size(), format, arguments);
  va_end(arguments);
  return buffer.data();
}

}  // namespace

Result<std::unique_ptr<SimulatedBench>> SimulatedBench::in(const BenchOptions& options,
                                                           Clock& clock) {
  const auto profile = sim::named_profile(options.profile);
  if (!profile) {
    return Error{"There is no profile '" + options.profile + "': write paper, standard or ice."};
  }
  BenchOptions own = options;
  std::error_code trouble;
  own.folder = fs::absolute(options.folder, trouble).lexically_normal().string();
  while (own.folder.size() > 1 && own.folder.ends_with('/')) own.folder.pop_back();
  if (own.folder.find_first_of("\"\\\n") != std::string::npos) {
    return Error{"The path " + own.folder + " cannot stand in a configuration; name another."};
  }
  fs::create_directories(own.folder + "/flights", trouble);
  if (trouble) {
    return Error{"The folder " + own.folder + "/flights cannot be made: " + trouble.message() +
                 "."};
  }
  auto flight = sim::BenchFlight::make(sim::with_width(*profile, kWidth_px), own.seed, kThreads);
  if (!flight) return flight.error();
  std::unique_ptr<SimulatedBench> bench(new SimulatedBench(own, clock, std::move(*flight)));
  if (const Status written = bench->write_files(); !written) return written.error();
  return bench;
}

SimulatedBench::SimulatedBench(const BenchOptions& options, Clock& clock, sim::BenchFlight flight)
    : folder_(options.folder),
      profile_(sim::with_width(*sim::named_profile(options.profile), kWidth_px)),
      seed_(options.seed),
      clock_(clock),
      flight_(std::move(flight)),
      begun_(clock.now()) {}

Status SimulatedBench::write_files() {
  const Status camera =
      write(folder_ + "/camera.toml", ingest::camera_toml(flight_.calibrated_camera()));
  if (!camera || fs::exists(configuration())) return camera;
  return write(configuration(), configuration_text());
}

std::string SimulatedBench::configuration_text() const {
  const std::string& in = folder_;
  return "# A bench: what is called simulated is not there. Edit it; it is not written anew.\n"
         "[receiver]\naddress = \"" +
         in + "/receiver\"\n\n[camera]\nid = \"simulated\"\ncalibration = \"" + in +
         "/camera.toml\"\n\n"
         "[release]\nby = \"pulse\"\nline = \"simulated\"\n"
         "# A picture takes long to paint; that of a camera is there at once.\n"
         "longest_delay_s = 10\n\n" +
         text("[capture]\nfirst_m = %g\nlast_m = %g\nstep_m = %g\n\n", profile_.from_m,
              profile_.to_m, profile_.step_m) +
         "[recording]\nfolder = \"" + in + "/flights\"\n\n[status]\nfile = \"" + in +
         "/status.json\"\nsocket = \"" + in + "/plumblined.sock\"\n";
}

Status SimulatedBench::start() {
  std::error_code ignored;
  if (fs::is_symlink(folder_ + "/receiver", ignored)) fs::remove(folder_ + "/receiver", ignored);
  port_ = std::make_unique<sim::LivePort>(clock_, folder_ + "/receiver", receiver());
  return port_->start();
}

// Whole seconds of UTC, as the receiver's epochs are: the wall's, or near them.
sim::LineSource SimulatedBench::receiver() const {
  sim::GnssStreamOptions options;
  options.fixed_sigma = profile_.gnss_error.white;
  options.least_latency = least_latency(seed_);
  options.host_at_start = begun_;
  options.utc_at_start = std::chrono::floor<std::chrono::seconds>(clock_.wall().wall);
  const auto path = [this](double seconds) { return flight_.antenna_at(seconds); };
  auto stream = std::make_shared<sim::GnssStream>(path, options, seed_);
  return [stream] { return std::optional<sim::LinePiece>(stream->next()); };
}

std::unique_ptr<Camera> SimulatedBench::make_camera(bool released) {
  sim::SimCameraOptions options;
  options.id = kSimulated;
  options.width_px = profile_.width_px;
  options.height_px = profile_.height_px;
  options.channels = 3;
  options.frames_per_s = kFramesPerSecond;
  options.row_time = {};
  options.sigma_stamp = std::chrono::microseconds(100);
  options.released = released;
  options.picture = [this](const ExposureTiming& exact) {
    const double middle_s = seconds_of(exact.middle_of_row(0));
    {
      const std::lock_guard lock(mutex_);
      exposures_s_.push_back(middle_s);
    }
    return flight_.photograph(middle_s);
  };
  auto camera = std::make_unique<sim::PacedCamera>(clock_, std::move(options));
  camera_ = camera.get();
  return camera;
}

std::unique_ptr<TriggerLine> SimulatedBench::make_release() {
  return std::make_unique<sim::ReleaseWire>(
      clock_, sim::ReleaseWire::Options{.seed = seed_},
      [camera = camera_](HostTime time) { camera->release(time); });
}

void SimulatedBench::decided(const capture::Decision& decision) {
  const std::lock_guard lock(mutex_);
  if (const auto* phase = std::get_if<capture::PhaseChanged>(&decision.what)) {
    if (phase->phase == capture::Phase::kFlying) taken_.clear();
  }
  const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what);
  if (taken == nullptr || taken->number == 0) return;
  taken_.push_back({text("%04d.jpg", taken->number), exposed_nearest(seconds_of(taken->exposed))});
}

double SimulatedBench::exposed_nearest(double seconds) const {
  const auto nearer = [&](double a, double b) {
    return std::abs(a - seconds) < std::abs(b - seconds);
  };
  const auto nearest = std::min_element(exposures_s_.begin(), exposures_s_.end(), nearer);
  return nearest == exposures_s_.end() ? seconds : *nearest;  // of a camera that is real
}

Status SimulatedBench::write_truth(const std::string& flight) {
  std::vector<sim::BenchFlight::Taken> taken;
  {
    const std::lock_guard lock(mutex_);
    taken = taken_;
  }
  const fs::path folder = fs::path(folder_) / "flights" / flight / "truth";
  std::error_code trouble;
  fs::create_directories(folder, trouble);
  const sim::Flight flown = flight_.flown(taken);
  const std::pair<const char*, std::string> files[] = {
      {"camera.toml", ingest::camera_toml(flown.camera)},
      {"photos.csv", sim::photos_csv(flown, flight_.frame())},
      {"picks.csv", sim::picks_csv(flight_.world(), flown)},
      {"check.csv", sim::check_csv(flight_.world(), flight_.frame())},
      {"surface.asc", sim::surface_asc(flight_.world(), kSurface_m)}};
  for (const auto& [name, content] : files) {
    if (Status written = write(folder / name, content); !written) return written;
  }
  return Done{};
}

}  // namespace plumbline
