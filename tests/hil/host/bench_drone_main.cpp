// SPDX-License-Identifier: MIT
// The flight of the virtual companion computer (scripts/bench --flight): what is outside it.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <thread>

#include "tests/hil/host/flight_truth.h"
#include "tests/hil/host/flown_bench.h"
#include "tests/hil/host/plugging_bench.h"

namespace plumbline::hil {
namespace {

using Json = nlohmann::json;

struct Arguments {
  DroneOptions drone;
  FlownOptions flown;
  std::vector<std::string> faults;
  std::uint64_t plugging_seed = 1;
  std::string command;  // of order
  int within_s = 60;
};

int fail(const Error& error) {
  std::fprintf(stderr, "bench_drone: %s\n", error.sentence.c_str());
  return 1;
}

std::string flown_json(const Arguments& a) { return a.flown.work + "/flown.json"; }

Result<Json> read_json(const std::string& path) {
  std::ifstream file(path);
  Json json = Json::parse(std::string{std::istreambuf_iterator<char>(file), {}}, nullptr, false);
  if (json.is_object()) return json;
  return Error{"There is no JSON in " + path + "."};
}

int fly(Arguments& a) {
  for (const std::string& text : a.faults) {
    const auto fault = fault_of(text);
    if (!fault)
      return fail({"There is no fault '" + text + "': cable, camera, stall, disk, power."});
    a.flown.faults.push_back(*fault);
  }
  const auto flight = flight_of(a.drone);
  if (!flight) return fail(flight.error());
  FlownBench bench(*flight, a.drone, a.flown);
  const auto flown = bench.fly();
  int status = 1;
  if (flown) {
    const Json json = {{"flight", flown->flight},
                       {"photos_stored", flown->photos_stored},
                       {"stored_at_cut", flown->stored_at_cut},
                       {"begun_ns", flown->begun_ns},
                       {"exposures_s", flown->exposures_s}};
    std::ofstream(flown_json(a)) << json.dump(1) << "\n";
    status = 0;
  } else {
    status = fail(flown.error());
  }
  std::fflush(nullptr);
  std::_Exit(status);  // QEMU goes on, and the camera's thread would wait for its end
}

int stand(const Arguments& a) {
  const auto flight = flight_of(a.drone);
  if (!flight) return fail(flight.error());
  Drone drone(*flight, a.drone);
  if (!drone.board(a.flown.sockets)) return fail({"QEMU takes neither receiver nor camera."});
  for (;;) std::this_thread::sleep_for(std::chrono::hours(1));
}

int plug(const Arguments& a) {
  const auto flight = flight_of(a.drone);
  if (!flight) return fail(flight.error());
  PluggingOptions options;
  options.sockets = a.flown.sockets;
  options.work = a.flown.work;
  options.cut_power = a.flown.cut_power;
  options.seed = a.plugging_seed;
  PluggingBench bench(*flight, a.drone, options);
  const auto failed = bench.run();
  const int status = failed ? (*failed == 0 ? 0 : 1) : fail(failed.error());
  std::fflush(nullptr);
  std::_Exit(status);  // QEMU goes on, and the camera's thread would wait for its end
}

int order(const Arguments& a) {
  GuestShell shell;
  const std::chrono::seconds at_most(a.within_s);
  if (!shell.open(a.flown.sockets + "/orders", at_most)) return fail({"Nobody takes orders."});
  const auto answer = shell.run(a.command, at_most);
  if (!answer) return fail({"The virtual computer did not answer: " + a.command});
  std::fputs(answer->output.c_str(), stdout);
  return answer->status;
}

int truth(const Arguments& a) {
  const auto flown = read_json(flown_json(a));
  if (!flown) return fail(flown.error());
  const auto flight = flight_of(a.drone);
  if (!flight) return fail(flight.error());
  const std::string recording = a.flown.work + "/" + flown->value("flight", "");
  const auto taken = read_marks(recording + "/photos", flown->value("begun_ns", std::int64_t{0}));
  if (!taken) return fail(taken.error());
  const UvcMode mode = mode_of(*flight, a.drone);
  const auto made = moments_to_show(*flight, heights_m_of(a.drone), mode);
  bool all_made = true;
  for (const auto& photo : *taken) {
    const double height_m = flight->pose_at(photo.seconds).centre_m.z();
    const auto moment = static_cast<int>(std::lround(photo.seconds * mode.frames_per_s));
    const bool is_made = std::binary_search(made.begin(), made.end(), moment);
    all_made = all_made && is_made;
    std::printf("%s  %7.2f s  %6.2f m%s\n", photo.photo.c_str(), photo.seconds, height_m,
                is_made ? "" : "  FAILED: not made ahead, but enlarged from another");
  }
  if (const Status written = write_truth(*flight, *taken, recording); !written) {
    return fail(written.error());
  }
  return all_made ? 0 : 1;
}

// The quantile of chi-square that lies where `normal` lies (Wilson and Hilferty 1931).
double chi_square(double freedoms, double normal) {
  const double part = 2 / (9 * freedoms);
  return freedoms * std::pow(1 - part + normal * std::sqrt(part), 3);
}

std::string three(const Json& check, const std::string& what) {
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "%.4f/%.4f/%.4f", check.value(what + "_e_m", NAN),
                check.value(what + "_n_m", NAN), check.value(what + "_u_m", NAN));
  return text.data();
}

// Measured against truth: the joint NEES lies inside its 99 % interval.
int judge(const Arguments& a) {
  const auto flown = read_json(flown_json(a));
  const auto summary = read_json(a.flown.work + "/checked/summary.json");
  if (!flown) return fail(flown.error());
  if (!summary) return fail(summary.error());
  constexpr double k99 = 2.5758;
  const Json& check = (*summary)["check"];
  const double nees = check.value("joint_nees", NAN), freedoms = check.value("joint_nees_dof", NAN);
  const double low = chi_square(freedoms, -k99), high = chi_square(freedoms, k99);
  const bool inside = nees >= low && nees <= high;
  std::printf(
      "%d photos, RMSE %s m east/north/up, bound %s m; %.0f %% within one sigma, %.0f %% within "
      "two; joint NEES %.1f (99 %% interval %.1f to %.1f)%s\n",
      flown->value("photos_stored", 0), three(check, "rmse").c_str(),
      three(check, "rms_stated_sigma").c_str(), 100 * check.value("share_within_one_sigma", NAN),
      100 * check.value("share_within_two_sigma", NAN), nees, low, high,
      inside ? "" : ": NOT AS STATED");
  return inside ? 0 : 1;
}

// What the journal says of a photo, from `plumbline check --dump`.
struct Said {
  std::string line;
  double height_m = NAN, sigma_m = NAN;
};

std::vector<Said> photos_said(const std::string& dump) {
  std::vector<Said> photos;
  std::ifstream file(dump);
  for (std::string line; std::getline(file, line);) {
    const std::size_t photo = line.find(" photo=");
    if (line.find(" taken ") == std::string::npos || photo == std::string::npos) continue;
    const auto value = [&](const std::string& key) {
      const std::size_t at = line.find(' ' + key + '=');
      return at == std::string::npos ? NAN : std::atof(line.c_str() + at + key.size() + 2);
    };
    if (value("photo") < 1) continue;  // a test pulse, on the ground
    photos.push_back({line.substr(photo + 1, line.find(" wanted=") - photo - 1), value("height_m"),
                      value("sigma_height_m")});
  }
  return photos;
}

// Of a flight whose camera kept its photos: each was exposed where the journal says.
int judge_exposures(const Arguments& a) {
  const auto flown = read_json(flown_json(a));
  const auto flight = flight_of(a.drone);
  if (!flown) return fail(flown.error());
  if (!flight) return fail(flight.error());
  const auto exposures_s = flown->value("exposures_s", std::vector<double>{});
  const std::vector<Said> photos = photos_said(a.flown.work + "/journal.txt");
  if (photos.empty() || exposures_s.size() < photos.size()) {
    return fail({"The journal knows of " + std::to_string(photos.size()) +
                 " photos, and the camera of " + std::to_string(exposures_s.size()) + "."});
  }
  constexpr double k99 = 2.3263;  // one-sided
  double squares = 0, squares_m2 = 0;
  const std::size_t tests = exposures_s.size() - photos.size();
  for (std::size_t i = 0; i < photos.size(); ++i) {
    const double true_m = flight->antenna_at(exposures_s[tests + i]).height_ellipsoidal_m -
                          flight->antenna_at(0).height_ellipsoidal_m;
    const double off_m = photos[i].height_m - true_m;
    squares += std::pow(off_m / photos[i].sigma_m, 2);
    squares_m2 += off_m * off_m;
    std::printf("%-36s exposed at %6.3f m, by the journal at %6.3f m, sigma %.3f m\n",
                photos[i].line.c_str(), true_m, photos[i].height_m, photos[i].sigma_m);
  }
  const auto count = static_cast<double>(photos.size());
  const double limit = chi_square(count, k99);
  std::printf(
      "%zu photos of a camera released by the line, RMSE of their heights %.3f m; squares over "
      "variances %.1f (99 %% below %.1f)%s\n",
      photos.size(), std::sqrt(squares_m2 / count), squares, limit,
      squares <= limit ? "" : ": NOT AS STATED");
  return squares <= limit ? 0 : 1;
}

}  // namespace
}  // namespace plumbline::hil

int main(int count, char** values) {
  using namespace plumbline::hil;
  Arguments a;
  CLI::App app{"What is outside the virtual companion computer: drone, receiver, camera, cables"};
  app.require_subcommand(1);
  app.add_option("--profile", a.drone.profile, "of the flight: paper, standard or ice");
  app.add_option("--from", a.drone.from_m, "its lowest photo, m, instead of the profile's");
  app.add_option("--to", a.drone.to_m, "its highest, m; there is no side-step then");
  app.add_option("--width", a.drone.width_px, "of the camera, pixels");
  app.add_option("--rate", a.drone.frames_per_s, "of the camera, frames per second");
  app.add_option("--seed", a.drone.seed, "of the flight");
  app.add_flag("--by-pulse", a.drone.by_pulse,
               "the camera is released by the shutter line, and keeps its photos");
  app.add_option("--work", a.flown.work, "folder of this flight");
  app.add_option("--sockets", a.flown.sockets, "folder of QEMU's sockets");
  int status = 0;
  CLI::App* flying = app.add_subcommand("fly", "configures, flies and lands");
  flying
      ->add_option("--fault", a.faults,
                   "cable, camera, stall, disk, power; cable@40: at 40 m; cable@40s: after 40 s")
      ->allow_extra_args(false);
  flying->callback([&] { status = fly(a); });
  CLI::App* plugging = app.add_subcommand("plug", "plugs receiver and camera in in each order");
  plugging->add_option("--at-random", a.plugging_seed, "seed of the times");
  plugging->callback([&] { status = plug(a); });
  for (CLI::App* command : {flying, plugging}) {
    command->add_option("--cut-power", a.flown.cut_power,
                        "command that takes the machine's power and starts it again");
  }
  app.add_subcommand("duration", "of the flight, s")->callback([&] {
    const auto flight = flight_of(a.drone);
    if (flight) std::printf("%.1f\n", flight->duration_s());
    status = flight ? 0 : fail(flight.error());
  });
  app.add_subcommand("stand", "stays on the ground, until it is killed")->callback([&] {
    status = stand(a);
  });
  app.add_subcommand("heights", "of the plan")->callback([&] {
    for (const double height_m : heights_m_of(a.drone)) std::printf("%.2f\n", height_m);
  });
  CLI::App* ordering = app.add_subcommand("order", "runs a command in the virtual computer");
  ordering->add_option("command", a.command)->required();
  ordering->add_option("--within", a.within_s, "seconds");
  ordering->callback([&] { status = order(a); });
  app.add_subcommand("truth", "writes truth/ beside the recording")->callback([&] {
    status = truth(a);
  });
  app.add_subcommand("judge", "holds what was measured against the truth")->callback([&] {
    status = judge(a);
  });
  app.add_subcommand("judge-exposures", "the same of a flight by pulses")->callback([&] {
    status = judge_exposures(a);
  });
  CLI11_PARSE(app, count, values);
  return status;
}
