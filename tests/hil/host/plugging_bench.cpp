// SPDX-License-Identifier: MIT
#include "tests/hil/host/plugging_bench.h"

#include <cstdlib>
#include <optional>
#include <utility>

namespace plumbline::hil {
namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::seconds;

// What the daemon last said may be a second old, and it may be slow to notice where it computes.
constexpr seconds kNoticesWithin(10);
constexpr double kUntilFirst_s = 25;  // a boot takes less
constexpr double kUntilSecond_s = 12;

SteadyClock::time_point after(SteadyClock::time_point time, double more_s) {
  return time + std::chrono::duration_cast<std::chrono::nanoseconds>(
                    std::chrono::duration<double>(more_s));
}

}  // namespace

PluggingBench::PluggingBench(const sim::BenchFlight& flight, const DroneOptions& drone,
                             PluggingOptions options)
    : flight_(flight),
      drone_options_(drone),
      options_(std::move(options)),
      random_(options_.seed),
      timeline_(options_.work + "/timeline.txt"),
      companion_(options_.sockets, timeline_),
      drone_(flight, drone) {}

Result<int> PluggingBench::run() {
  if (!drone_.board(options_.sockets)) return Error{"QEMU takes neither receiver nor camera."};
  if (Status up = companion_.connect(options_.up_within); !up) return up.error();
  if (Status set = companion_.configure(flight_, drone_options_); !set) return set.error();
  const Status ready = companion_.wait_until("is not ready", Companion::is_ready,
                                             SteadyClock::now() + options_.boot_ready_within);
  if (!ready) return ready.error();
  static constexpr Round kRounds[] = {
      {"while it boots, the receiver first", true, true, true, true},
      {"while it boots, the camera first", true, true, true, false},
      {"while it runs, the receiver first", false, true, true, true},
      {"while it runs, the camera first", false, true, true, false},
      {"the receiver alone", false, true, false, true},
      {"the camera alone", false, false, true, false},
  };
  int failed = 0;
  for (const Round& round : kRounds) {
    timeline_.say(std::string("NEXT ") + round.what);
    const Status done = play(round);
    if (!done) timeline_.say("FAILED: " + done.error().sentence);
    failed += done ? 0 : 1;
  }
  return failed;
}

Status PluggingBench::play(const Round& round) {
  if (Status pulled = pull(round); !pulled) return pulled;
  if (Status plugged = plug(round); !plugged) return plugged;
  const auto within = round.at_boot ? options_.boot_ready_within : options_.ready_within;
  const SteadyTime begun = SteadyClock::now();
  const Status ready = companion_.wait_until("is not ready", Companion::is_ready, begun + within);
  if (!ready) return ready;
  const std::chrono::duration<double> took = SteadyClock::now() - begun;
  timeline_.say("ready " + std::to_string(took.count()) + " s after both were there");
  return round.at_boot ? companion_.connect(options_.up_within) : Status(Done{});
}

Status PluggingBench::pull(const Round& round) {
  if (round.pulls_camera) drone_.camera().plugged = false;
  if (!round.at_boot) {
    if (round.pulls_receiver) drone_.pull_receiver();
    timeline_.say("pulled");
    return companion_.wait_until(
        "does not say what is missing",
        [](const nlohmann::json& status) { return !Companion::is_ready(status); },
        SteadyClock::now() + kNoticesWithin);
  }
  timeline_.untie_guest();
  if (std::system(options_.cut_power.c_str()) != 0) {
    return Error{"This failed: " + options_.cut_power};
  }
  drone_.leave();
  if (!drone_.board(options_.sockets)) return Error{"QEMU takes neither receiver nor camera."};
  drone_.pull_receiver();
  timeline_.say("power is off and on again, with nothing plugged in");
  return companion_.listen();
}

// At the drawn times; fails where the daemon says that it is ready before.
Status PluggingBench::plug(const Round& round) {
  const bool both = round.pulls_receiver && round.pulls_camera;
  const SteadyTime first = after(SteadyClock::now(), drawn(kUntilFirst_s));
  const SteadyTime second = both ? after(first, drawn(kUntilSecond_s)) : first;
  std::optional<SteadyTime> receiver_at, camera_at;
  if (round.pulls_receiver) receiver_at = round.receiver_first ? first : second;
  if (round.pulls_camera) camera_at = round.receiver_first ? second : first;
  std::optional<std::string> wrong;
  const auto plug_due = [&] {
    const SteadyTime now = SteadyClock::now();
    if (receiver_at && now >= *receiver_at) {
      receiver_at.reset();
      timeline_.say("the receiver is plugged in");
      if (!drone_.plug_receiver(options_.sockets)) wrong = "QEMU does not take the receiver.";
    }
    if (camera_at && now >= *camera_at) {
      camera_at.reset();
      timeline_.say("the camera is plugged in");
      drone_.camera().plugged = true;
    }
  };
  const auto is_over = [&](const nlohmann::json& status) {
    if (!receiver_at && !camera_at) return true;
    if (Companion::is_ready(status))
      wrong = "It says that it is ready, and something is not plugged in.";
    return wrong.has_value();
  };
  // It ends in time or with `wrong`; a machine that boots says nothing yet.
  (void)companion_.wait_until("says nothing", is_over, after(second, 1), plug_due);
  return wrong ? Status(Error{*wrong}) : Status(Done{});
}

}  // namespace plumbline::hil
