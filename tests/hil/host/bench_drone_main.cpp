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

#include "tests/hil/host/flight_truth.h"
#include "tests/hil/host/flown_bench.h"

namespace plumbline::hil {
namespace {

using Json = nlohmann::json;

struct Arguments {
  DroneOptions drone;
  FlownOptions flown;
  std::vector<std::string> faults;
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
                       {"begun_ns", flown->begun_ns}};
    std::ofstream(flown_json(a)) << json.dump(1) << "\n";
    status = 0;
  } else {
    status = fail(flown.error());
  }
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
  app.add_option("--work", a.flown.work, "folder of this flight");
  app.add_option("--sockets", a.flown.sockets, "folder of QEMU's sockets");
  int status = 0;
  CLI::App* flying = app.add_subcommand("fly", "configures, flies and lands");
  flying->add_option("--fault", a.faults, "cable, camera, stall, disk, power; cable@40: at 40 m")
      ->allow_extra_args(false);
  flying->add_option("--cut-power", a.flown.cut_power,
                     "command that takes the machine's power and starts it again");
  flying->callback([&] { status = fly(a); });
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
  CLI11_PARSE(app, count, values);
  return status;
}
