// SPDX-License-Identifier: MIT
#include "tests/hil/host/flown_bench.h"

#include <cstdlib>
#include <string_view>
#include <utility>

namespace plumbline::hil {
namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::seconds;

constexpr double kLandsWithin_s = 30;
// The flight's folder is closed some seconds after it stands on the ground.
constexpr seconds kAfterLanding(120);

}  // namespace

std::optional<Fault> fault_of(const std::string& text) {
  static const Fault kKnown[] = {{"cable", 32, {}, 4, 10, 2},
                                 {"camera", 55, {}, 6, 1, 0},
                                 {"stall", 55, {}, 6, 1, 0},
                                 {"disk", 55, {}, 6, 1, 0},
                                 {"power", 55, {}, 0, 1, 0}};
  const std::size_t at = text.find('@');
  for (Fault fault : kKnown) {
    if (text.substr(0, at) != fault.name) continue;
    if (at == std::string::npos) return fault;
    char* unit = nullptr;
    const double from = std::strtod(text.c_str() + at + 1, &unit);
    fault.times = 1;
    const std::string_view rest(unit);
    if (rest == "s") fault.from_s = from;
    if (rest.empty()) fault.from_height_m = from;
    if (!rest.empty() && rest != "s") return std::nullopt;
    return fault;
  }
  return std::nullopt;
}

FlownBench::FlownBench(const sim::BenchFlight& flight, const DroneOptions& drone,
                       FlownOptions options)
    : flight_(flight),
      drone_options_(drone),
      options_(std::move(options)),
      timeline_(options_.work + "/timeline.txt"),
      companion_(options_.sockets, timeline_),
      drone_(flight, drone) {
  for (const Fault& fault : options_.faults) doings_.push_back({.fault = fault});
}

Result<Flown> FlownBench::fly() {
  using Step = Status (FlownBench::*)();
  for (const Step step :
       {&FlownBench::board, &FlownBench::configure, &FlownBench::take_off, &FlownBench::land}) {
    if (Status done = (this->*step)(); !done) return done.error();
  }
  for (const SteadyTime exposed : drone_.lines().exposures()) {
    flown_.exposures_s.push_back(drone_.seconds(exposed));
  }
  return flown_;
}

Status FlownBench::configure() { return companion_.configure(flight_, drone_options_); }

Status FlownBench::take_off() {
  const SteadyTime deadline = SteadyClock::now() + options_.ready_within;
  if (Status ready = companion_.wait_until("is not ready", Companion::is_ready, deadline); !ready)
    return ready;
  timeline_.say("the daemon is ready");
  if (const FlightView* view = drone_.view()) {
    timeline_.say(std::to_string(view->made()) + " of " + std::to_string(view->pictures()) +
                  " pictures are made");
    const auto all_made = [view](const Json&) { return view->made() == view->pictures(); };
    if (Status made = companion_.wait_until("has no pictures", all_made, deadline); !made)
      return made;
  }
  const SteadyTime begun = drone_.take_off();
  timeline_.take_off(begun);
  timeline_.say("the drone's flight begins");
  flown_.begun_ns = begun.time_since_epoch().count();
  return Done{};
}

Status FlownBench::land() {
  bool has_flown = false;
  const auto has_landed = [&](const Json& status) {
    const std::string phase = status.value("phase", "");
    has_flown |= phase == "flying";
    flown_.photos_stored = std::max(flown_.photos_stored, status.value("photos_stored", 0));
    if (phase == "flying") under_way_ = status.value("flight", "");
    flown_.flight = status.value("last_flight", "");
    const bool is_over = drone_.seconds(SteadyClock::now()) > flight_.duration_s() + kLandsWithin_s;
    if (flown_.flight.empty() && is_over) flown_.flight = cut_on_ground_;
    return has_flown && phase != "flying" && !flown_.flight.empty();
  };
  const double left_s = flight_.duration_s() - drone_.seconds(SteadyClock::now());
  const auto deadline = SteadyClock::now() + seconds(static_cast<int>(left_s)) + kAfterLanding;
  const Status landed = companion_.wait_until("does not say that it has landed", has_landed,
                                              deadline, [this] { do_faults(); });
  if (!landed) return landed;
  timeline_.say("landed, " + std::to_string(flown_.photos_stored) + " photos stored in " +
                flown_.flight);
  return Done{};
}

Status FlownBench::board() {
  if (!drone_.board(options_.sockets)) return Error{"QEMU takes neither receiver nor camera."};
  return companion_.connect(options_.ready_within);
}

void FlownBench::do_faults() {
  for (Doing& doing : doings_) do_fault(doing);
}

bool FlownBench::reaches(const Fault& fault, SteadyTime now) const {
  if (fault.from_s) return drone_.seconds(now) >= *fault.from_s;
  return drone_.height_m(now) >= fault.from_height_m;
}

void FlownBench::do_fault(Doing& doing) {
  const Fault& fault = doing.fault;
  const SteadyTime now = SteadyClock::now();
  if (!doing.reached && reaches(fault, now)) {
    doing.reached = true;
    doing.next = now;
  }
  const bool more = doing.is_on || doing.begun < fault.times;
  if (!doing.reached || !more || now < doing.next) return;
  const Status done = doing.is_on ? end_fault(fault.name) : begin_fault(fault.name);
  timeline_.say("FAULT " + fault.name + (doing.is_on ? " is over" : " begins") +
                (done ? "" : ": " + done.error().sentence));
  doing.begun += doing.is_on ? 0 : 1;
  doing.is_on = !doing.is_on;
  const double until_s = doing.is_on ? fault.lasts_s : fault.apart_s;
  doing.next = SteadyClock::now() + std::chrono::duration_cast<std::chrono::nanoseconds>(
                                        std::chrono::duration<double>(until_s));
}

Status FlownBench::begin_fault(const std::string& name) {
  if (name == "power") return cut_power();
  if (name == "camera") drone_.camera().plugged = false;
  if (name == "stall") drone_.camera().silent = true;
  if (name == "cable" && !companion_.cables().pull("gnss"))
    return Error{"QEMU does not pull the cable."};
  if (name != "disk") return Done{};
  return companion_.order(
      "cd /var/lib && for size in 1M 4k; do dd if=/dev/zero of=full.$size bs=$size 2>/dev/null; "
      "done; :");
}

Status FlownBench::end_fault(const std::string& name) {
  if (name == "camera") drone_.camera().plugged = true;
  if (name == "stall") drone_.camera().silent = false;
  if (name == "cable" &&
      !companion_.cables().plug(
          R"({"driver":"usb-serial","id":"gnss","chardev":"gnss","bus":"xhci.0"})")) {
    return Error{"QEMU does not plug the cable in again."};
  }
  return name == "disk" ? companion_.order("rm -f /var/lib/full.*") : Done{};
}

// The drone flies on while its computer starts anew.
Status FlownBench::cut_power() {
  flown_.stored_at_cut = flown_.photos_stored;
  // The daemon that is started there may have nothing to land.
  const SteadyTime now = SteadyClock::now();
  const bool comes_down = drone_.seconds(now) > flight_.duration_s() / 2;
  if (comes_down && drone_.height_m(now) < 1) cut_on_ground_ = under_way_;
  timeline_.say("power is cut, with " + std::to_string(flown_.stored_at_cut) +
                " photos said to be stored");
  if (std::system(options_.cut_power.c_str()) != 0) {
    return Error{"This failed: " + options_.cut_power};
  }
  drone_.leave();
  return board();
}

}  // namespace plumbline::hil
