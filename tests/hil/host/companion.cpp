// SPDX-License-Identifier: MIT
#include "tests/hil/host/companion.h"

#include <cstdlib>
#include <utility>

#include "firmware/ingest/camera_toml.h"

namespace plumbline::hil {
namespace {

using SteadyClock = std::chrono::steady_clock;

constexpr std::chrono::seconds kOrder(60);
constexpr std::chrono::milliseconds kLook(100);  // between two things that are to be done

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

Companion::Companion(std::string sockets, Timeline& timeline)
    : sockets_(std::move(sockets)), timeline_(timeline) {}

Status Companion::connect(std::chrono::seconds at_most) {
  shell_ = GuestShell();
  cables_ = Cables();
  if (Status listening = listen(); !listening) return listening;
  if (!cables_.open(sockets_ + "/qmp") || !shell_.open(sockets_ + "/orders", at_most)) {
    return Error{"Nobody answers at the sockets in " + sockets_ +
                 ": has the virtual computer been started, and come up (kernel.log)?"};
  }
  const auto uptime = shell_.run("cat /proc/uptime", kOrder);
  if (!uptime) return Error{"The virtual computer does not tell the time."};
  timeline_.tie_guest(std::atof(uptime->output.c_str()), SteadyClock::now());
  timeline_.say("the virtual computer is up");
  return Done{};
}

Status Companion::listen() {
  status_lines_ = LineSocket();
  if (status_lines_.open(sockets_ + "/status")) return Done{};
  return Error{"There is no socket in " + sockets_ + ": has the virtual computer been started?"};
}

bool Companion::is_ready(const Json& status) {
  return status.value("sentence", "").starts_with("Ready");
}

Status Companion::order(const std::string& command) {
  const auto answer = shell_.run(command, kOrder);
  if (!answer) return Error{"The virtual computer did not answer: " + command};
  if (answer->status == 0) return Done{};
  return Error{"In the virtual computer failed: " + command + "\n" + answer->output};
}

Status Companion::configure(const sim::BenchFlight& flight, const DroneOptions& options) {
  const std::string calibration = base64(ingest::camera_toml(flight.calibrated_camera()));
  for (const std::string& command :
       {"echo " + calibration + " | base64 -d >/etc/plumbline/camera.toml",
        "sed -i '" + edits_for(options) + "' /etc/plumbline/plumbline.toml",
        std::string("sync"),  // as an editor does
        std::string("plumblined --check"), std::string("systemctl restart plumblined")}) {
    if (Status done = order(command); !done) return done;
  }
  timeline_.say("configured, and the daemon restarted");
  return Done{};
}

Status Companion::wait_until(const std::string& what, const std::function<bool(const Json&)>& is_so,
                             SteadyTime deadline, const std::function<void()>& meanwhile) {
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

void Companion::follow(const Json& status) {
  if (!status.is_object()) return;
  std::string text = status.value("sentence", "");
  if (text == shown_) return;
  shown_ = text;
  timeline_.say(text);
}

}  // namespace plumbline::hil
