// SPDX-License-Identifier: MIT
#include "tests/hil/host/flown_bench.h"

#include <array>
#include <cstdlib>
#include <string_view>
#include <utility>

#include "firmware/ingest/camera_toml.h"

namespace plumbline::hil {
namespace {

using SteadyClock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr seconds kOrder(60);
constexpr milliseconds kLook(100);  // at the drone, between two lines of the status
constexpr double kLandsWithin_s = 30;
// The flight's folder is closed some seconds after it stands on the ground.
constexpr seconds kAfterLanding(120);

std::string base64(const std::string& bytes) {
  static constexpr char kLetters[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    unsigned group = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const bool there = i + k < bytes.size();
      group = group << 8 | (there ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    }
    for (std::size_t k = 0; k < 4; ++k) {
      const bool there = i + k <= bytes.size();
      text += there ? kLetters[group >> (18 - 6 * k) & 63U] : '=';
    }
  }
  return text;
}

std::string seconds_text(double value) {
  std::array<char, 32> text{};
  std::snprintf(text.data(), text.size(), "%7.1f s", value);
  return text.data();
}

double in_s(std::chrono::nanoseconds time) { return std::chrono::duration<double>(time).count(); }

// What its user changes in the installed configuration: the camera's calibration, the heights, and
// the lines where there are some.
std::string edits_for(const DroneOptions& options) {
  std::string heights;
  for (const double height_m : heights_m_of(options)) {
    heights += (heights.empty() ? "" : ", ") + std::to_string(height_m);
  }
  std::string edits =
      "s|^#calibration = .*|calibration = \"/etc/plumbline/camera.toml\"|; "
      "s|^#heights_m = .*|heights_m = [" +
      heights + "]|";
  if (options.by_pulse) {
    edits +=
        "; s|^#id = .*|id = \"none\"|; s|^#by = \"frame\"|by = \"pulse\"|; s|^#line = .*|line = "
        "\"SHUTTER\"|; "
        "s|^#feedback_line = .*|feedback_line = \"FLASH\"|; s|^#pps = .*|pps = \"gpio:PPS\"|";
  }
  return edits;
}

}  // namespace

void Timeline::say(const std::string& text) {
  const SteadyTime now = SteadyClock::now();
  std::string line = seconds_text(in_s(now - began_)) + "   guest ";
  line += guest_began_ ? seconds_text(in_s(now - *guest_began_)) : "        -";
  line += "   flight " + (took_off_ ? seconds_text(in_s(now - *took_off_)) : "        -");
  line += "   " + text + "\n";
  for (std::FILE* out : {stdout, file_}) {
    if (out == nullptr) continue;
    std::fputs(line.c_str(), out);
    std::fflush(out);
  }
}

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

Status FlownBench::take_off() {
  const auto is_ready = [](const Json& status) {
    return status.value("sentence", "").starts_with("Ready");
  };
  const SteadyTime deadline = SteadyClock::now() + options_.ready_within;
  if (Status ready = wait_until("is not ready", is_ready, deadline); !ready) return ready;
  timeline_.say("the daemon is ready");
  if (const FlightView* view = drone_.view()) {
    timeline_.say(std::to_string(view->made()) + " of " + std::to_string(view->pictures()) +
                  " pictures are made");
    const auto all_made = [view](const Json&) { return view->made() == view->pictures(); };
    if (Status made = wait_until("has no pictures", all_made, deadline); !made) return made;
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
  const Status landed =
      wait_until("does not say that it has landed", has_landed, deadline, [this] { do_faults(); });
  if (!landed) return landed;
  timeline_.say("landed, " + std::to_string(flown_.photos_stored) + " photos stored in " +
                flown_.flight);
  return Done{};
}

Status FlownBench::board() {
  shell_ = GuestShell();
  cables_ = Cables();
  status_lines_ = LineSocket();
  if (!drone_.board(options_.sockets)) return Error{"QEMU takes neither receiver nor camera."};
  if (!cables_.open(options_.sockets + "/qmp") ||
      !status_lines_.open(options_.sockets + "/status") ||
      !shell_.open(options_.sockets + "/orders", options_.ready_within)) {
    return Error{"Nobody answers at the sockets in " + options_.sockets +
                 ": has the virtual computer been started, and come up (kernel.log)?"};
  }
  const auto uptime = shell_.run("cat /proc/uptime", kOrder);
  if (!uptime) return Error{"The virtual computer does not tell the time."};
  timeline_.tie_guest(std::atof(uptime->output.c_str()), SteadyClock::now());
  timeline_.say("the virtual computer is up");
  return Done{};
}

Status FlownBench::order(const std::string& command) {
  const auto answer = shell_.run(command, kOrder);
  if (!answer) return Error{"The virtual computer did not answer: " + command};
  if (answer->status == 0) return Done{};
  return Error{"In the virtual computer failed: " + command + "\n" + answer->output};
}

Status FlownBench::configure() {
  const std::string calibration = base64(ingest::camera_toml(flight_.calibrated_camera()));
  for (const std::string& command :
       {"echo " + calibration + " | base64 -d >/etc/plumbline/camera.toml",
        "sed -i '" + edits_for(drone_options_) + "' /etc/plumbline/plumbline.toml",
        std::string("plumblined --check"), std::string("systemctl restart plumblined")}) {
    if (Status done = order(command); !done) return done;
  }
  timeline_.say("configured, and the daemon restarted");
  return Done{};
}

Status FlownBench::wait_until(const std::string& what,
                              const std::function<bool(const Json&)>& is_so, SteadyTime deadline,
                              const std::function<void()>& meanwhile) {
  Json status;
  while (SteadyClock::now() < deadline) {
    if (const auto line = status_lines_.next(SteadyClock::now() + kLook)) {
      Json read = Json::parse(*line, nullptr, false);
      if (read.is_object()) status = std::move(read);
      follow(status);
    }
    if (!status_lines_.is_open()) return Error{"QEMU has ended."};
    if (status.is_object() && is_so(status)) return Done{};
    if (meanwhile) meanwhile();
  }
  return Error{"The daemon " + what + " in time. It last said: " +
               (status.is_object() ? status.value("sentence", "") : "nothing")};
}

void FlownBench::follow(const Json& status) {
  if (!status.is_object()) return;
  std::string text = status.value("sentence", "");
  if (text == shown_) return;
  shown_ = text;
  timeline_.say(text);
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
  if (name == "cable" && !cables_.pull("gnss")) return Error{"QEMU does not pull the cable."};
  if (name != "disk") return Done{};
  return order(
      "cd /var/lib && for size in 1M 4k; do dd if=/dev/zero of=full.$size bs=$size 2>/dev/null; "
      "done; :");
}

Status FlownBench::end_fault(const std::string& name) {
  if (name == "camera") drone_.camera().plugged = true;
  if (name == "stall") drone_.camera().silent = false;
  if (name == "cable" &&
      !cables_.plug(R"({"driver":"usb-serial","id":"gnss","chardev":"gnss","bus":"xhci.0"})")) {
    return Error{"QEMU does not plug the cable in again."};
  }
  return name == "disk" ? order("rm -f /var/lib/full.*") : Done{};
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
