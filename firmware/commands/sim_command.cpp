// SPDX-License-Identifier: MIT
#include "firmware/commands/sim_command.h"

#include <unistd.h>

#include <cstdio>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "edge/jpeg/jpeg.h"
#include "firmware/commands/number_check.h"
#include "firmware/commands/sim_flown.h"
#include "firmware/commands/sim_output.h"
#include "firmware/ingest/text_file.h"
#include "sim/flight.h"
#include "sim/profile.h"

namespace plumbline::commands {
namespace {

constexpr std::size_t kLargestProfileBytes = 1 << 20;
constexpr std::size_t kLargestPhotoBytes = 500u << 20;

struct SimOptions {
  std::string out;
  std::string profile = "paper";
  std::uint64_t seed = 1;
  std::string texture;
  // Each of these stands for a key of the profile where given.
  std::optional<double> from_m, to_m, step_m;
  std::vector<double> side_steps_m;
  std::optional<double> side_direction_deg;
  std::vector<double> rtk_m;
  std::string fix;
  bool no_gnss = false;
  bool fly = false;
  std::optional<double> heading_sigma_deg;
  int threads = 0;
};

Result<sim::Profile> base_profile(const std::string& word) {
  if (const auto named = sim::named_profile(word)) return *named;
  const std::filesystem::path path = word;
  if (!std::filesystem::exists(path)) {
    return Error{"'" + word + "' is neither a profile (paper, standard, ice) nor a file: " +
                 "see sim/profile_example.toml for a file of your own."};
  }
  const auto text = ingest::read_text_file(path, kLargestProfileBytes);
  if (!text) return text.error();
  return sim::parse_profile(*text, path.filename().string());
}

Result<sim::Profile> wanted_profile(const SimOptions& options) {
  auto profile = base_profile(options.profile);
  if (!profile) return profile;
  if (options.from_m) profile->from_m = *options.from_m;
  if (options.to_m) profile->to_m = *options.to_m;
  if (options.step_m) profile->step_m = *options.step_m;
  if (!options.side_steps_m.empty()) {
    profile->side_steps_m = options.side_steps_m;
    std::erase(profile->side_steps_m, 0.0);
  }
  if (options.side_direction_deg) profile->side_direction_deg = options.side_direction_deg;
  if (const auto fix = sim::fix_of(options.fix)) sim::set_fix(*profile, *fix);
  if (!options.rtk_m.empty()) profile->gnss_error.white = {options.rtk_m[0], options.rtk_m[1]};
  if (options.no_gnss) profile->gnss = false;
  if (options.heading_sigma_deg) {
    profile->heading = true;
    profile->heading_sigma_deg = *options.heading_sigma_deg;
  }
  if (const Status fit = sim::check(*profile); !fit) return fit.error();
  return profile;
}

Result<std::optional<Image>> ground_photo(const std::string& path) {
  if (path.empty()) return std::optional<Image>();
  const auto bytes = ingest::read_bytes(path, kLargestPhotoBytes);
  if (!bytes) return bytes.error();
  auto image = jpeg::decode_rgb(*bytes, path);
  if (!image) return image.error();
  if (image->width_px < 64 || image->height_px < 64) {
    return Error{path +
                 " is too small for a ground texture: give a photo of 64 pixels a side or more."};
  }
  return std::optional<Image>(std::move(*image));
}

Progress terminal_progress() {
  if (isatty(STDERR_FILENO) == 0) return [](const std::string&, int, int) {};
  return [](const std::string& stage, int done, int total) {
    std::fprintf(stderr, "\r\033[K%s: %d of %d%s", stage.c_str(), done, total,
                 done == total ? "\n" : "");
    std::fflush(stderr);
  };
}

int thread_count(int wanted) {
  if (wanted > 0) return wanted;
  return std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
}

Result<SimulatedFolder> simulate(const SimOptions& options) {
  const auto profile = wanted_profile(options);
  if (!profile) return profile.error();
  const auto photo = ground_photo(options.texture);
  if (!photo) return photo.error();
  const int threads = thread_count(options.threads);
  if (options.fly) {
    const FlownFlight flown{*profile, options.seed, *photo, threads};
    return write_flown_flight(flown, options.out, terminal_progress());
  }
  const sim::Flight flight = sim::fly(*profile, options.seed);
  return write_simulated_flight(flight, *photo, options.out, threads, terminal_progress());
}

int run_sim(const SimOptions& options) {
  const auto made = simulate(options);
  if (!made) {
    std::fprintf(stderr, "plumbline sim: %s\n", made.error().sentence.c_str());
    return 1;
  }
  const char* out = options.out.c_str();
  std::printf("%d photos of %d targets in %s\n", made->photos, made->targets, out);
  std::printf(
      "measure them: plumbline measure %s --picks %s/truth/picks.csv --check %s/truth/check.csv\n",
      out, out, out);
  if (options.fly) std::printf("decide again: plumbline replay %s\n", out);
  return 0;
}

void add_climb_options(CLI::App& sub, SimOptions& options) {
  sub.add_option("--from", options.from_m, "lowest height above the ground, metres")
      ->check(number_within(5, 1000));
  sub.add_option("--to", options.to_m, "highest height, metres")->check(number_within(5, 1000));
  sub.add_option("--step", options.step_m, "height between photos, metres")
      ->check(number_within(0.1, 1000));
  sub.add_option("--side-step", options.side_steps_m,
                 "metres aside at the top; several (10,10): each turned 90 degrees; 0: none")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->check(number_within(0, 500));
  sub.add_option("--side-direction", options.side_direction_deg,
                 "azimuth of the first side-step, degrees; random by default")
      ->check(number_within(-360, 360));
}

void add_gnss_options(CLI::App& sub, SimOptions& options) {
  sub.add_option("--fix", options.fix,
                 "kind of GNSS fix, with the errors that go with it: fixed, float, single")
      ->check(CLI::IsMember({"fixed", "float", "single"}));
  sub.add_option("--rtk", options.rtk_m, "white sigma H,V of the positions, metres")
      ->delimiter(',')
      ->expected(2)
      ->check(number_within(0, 1000));
  sub.add_flag("--no-gnss", options.no_gnss, "write no positions");
  sub.add_option(
         "--heading", options.heading_sigma_deg,
         "write the gimbal's yaw, by a compass with this sigma, degrees (2 where not given)")
      ->expected(0, 1)
      ->default_str("2")
      ->check(number_within(0, 180));
}

}  // namespace

void add_sim(CLI::App& app, int& status) {
  auto options = std::make_shared<SimOptions>();
  CLI::App* sub = app.add_subcommand("sim", "a simulated flight, with its truth beside it");
  sub->add_option("OUT", options->out, "folder to write, new or empty")->required();
  sub->add_option("--profile", options->profile, "paper, standard, ice, or a TOML file")
      ->capture_default_str();
  sub->add_option("--seed", options->seed, "the same seed gives the same bytes")
      ->capture_default_str();
  sub->add_option("--texture", options->texture, "a JPEG photo to use as ground");
  add_climb_options(*sub, *options);
  add_gnss_options(*sub, *options);
  sub->add_flag("--fly", options->fly,
                "fly it as the daemon would: its own code decides when to take the photos, and "
                "writes flight.journal, for replay and check")
      ->excludes("--no-gnss")
      ->excludes("--heading")
      ->excludes("--side-direction");
  sub->add_option("--threads", options->threads, "0: as many as the machine has")
      ->check(CLI::Range(0, 256));
  sub->footer(
      "Example: plumbline sim climb --profile paper --side-step 10 --rtk 0.005,0.010 --seed 7\n"
      "         plumbline measure climb --picks climb/truth/picks.csv --check "
      "climb/truth/check.csv\n"
      "         plumbline sim flown --fly --profile standard && plumbline replay flown\n"
      "Without --fly the photos are taken where the profile says, with positions in their EXIF; "
      "with "
      "it, where\n"
      "          the daemon takes them, with positions in the recording, as of a real flight.\n"
      "Profiles: paper 70 to 90 m every 5 m; standard 30 to 90 m every 5 m, then 10 m aside;\n"
      "          ice 10 to 60 m every 2.5 m, then 5 m aside. A file: sim/profile_example.toml.");
  sub->callback([options, &status] { status = run_sim(*options); });
}

}  // namespace plumbline::commands
