// SPDX-License-Identifier: MIT
#include "tests/soak/flown_day.h"

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <thread>
#include <utility>
#include <variant>

#include "edge/gnss/stream_decoder.h"

namespace plumbline::soak {
namespace {

using std::chrono::minutes;
using std::chrono::seconds;

constexpr int kFlight_s = 90;  // from one to the next
constexpr int kHour_s = 3600;
constexpr seconds kLookEvery{5};
constexpr seconds kClimbing{22};  // after a flight's begin: above 20 m, below 30 m
constexpr seconds kTrouble{4};    // lasts so long
// Half an hour after the last flight of the hour the record of the ground was begun anew, and is
// short.
constexpr seconds kEndOfHour = minutes(59) + seconds(58);

sim::ClimbPathOptions short_climb() {
  sim::ClimbPathOptions options;
  options.wait_s = 10;
  options.top_m = 47;
  options.aside_m = 11;
  return options;
}

sim::GnssStreamOptions receiver_options() {
  sim::GnssStreamOptions options;
  options.llh = true;
  options.fixed_sigma = {0.005, 0.010};
  options.host_rate_error = 40e-6;
  return options;
}

sim::SimCameraOptions camera_options() {
  sim::SimCameraOptions options;
  options.frames_per_s = 5;
  options.sigma_stamp = std::chrono::milliseconds(1);
  return options;
}

// In which flight of the hour, and since when; flight kFlightsAnHour: on the ground for long.
std::pair<int, double> moment_of(double seconds) {
  const double in_hour_s = seconds - kHour_s * std::floor(seconds / kHour_s);
  const int flight = static_cast<int>(in_hour_s / kFlight_s);
  if (flight >= kFlightsAnHour) return {kFlightsAnHour, 0};
  return {flight, in_hour_s - kFlight_s * flight};
}

bool is_armed(HostTime time) {
  const auto [flight, since_s] =
      moment_of(std::chrono::duration<double>(time.time_since_epoch()).count());
  return flight < kFlightsAnHour && since_s > 7 && since_s < 80;
}

// Whether a thread of this process besides this one does something: those that advise and show.
bool is_one_busy() {
  for (const auto& task : std::filesystem::directory_iterator("/proc/self/task")) {
    if (task.path().filename() == std::to_string(::gettid())) continue;
    std::ifstream file(task.path() / "stat");
    std::string stat;
    std::getline(file, stat);
    if (stat.find(") S ") == std::string::npos) return true;
  }
  return false;
}

void wait_for_other_threads() {
  for (int looks = 0; looks < 3; ++looks) {
    if (is_one_busy()) looks = -1;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
}

}  // namespace

FlownDay::FlownDay(int hours, const std::string& folder)
    : hours_(hours),
      folder_(folder),
      frame_(*geodesy::LocalFrame::at({35.66, 139.76, 52.3})),
      path_(short_climb(), 1),
      stream_([this](double s) { return place_at(s); }, receiver_options(), 1),
      receiver_(clock_, gnss::make_fix_decoder),
      camera_(clock_, camera_options()),
      pilot_(clock_, is_armed) {}

geodesy::Geodetic FlownDay::place_at(double seconds) const {
  return frame_.geodetic_of(path_.at(moment_of(seconds).second));
}

config::Config FlownDay::configuration() const {
  config::Config config;
  config.capture.plan.heights_m = {30, 35, 40, 45};
  config.capture.take_off.by = capture::TakeOffBy::kArmed;
  config.recording.folder = folder_;
  config.status.file = folder_ + "/status.json";
  config.status.socket = folder_ + "/socket";
  config.measure.enabled = false;
  return config;
}

Status FlownDay::live(std::function<void(int hour, const FlownHour&)> done) {
  done_ = std::move(done);
  flight::Devices devices{clock_, disk_, receiver_, &camera_};
  devices.pilot = &pilot_;
  auto daemon = service::Daemon::start(configuration(), "", devices, events(), {.threads = false});
  if (!daemon) return daemon.error();
  daemon_ = std::move(*daemon);
  plan_hour(0);
  say_on();
  clock_.after(kLookEvery, [this] { look(); });
  daemon_->run();
  daemon_.reset();
  return Done{};
}

service::DaemonEvents FlownDay::events() {
  service::DaemonEvents events;
  events.told = [this](const std::string& sentence) {
    if (sentence.find(" is stored in ") != std::string::npos) ++hour_.stored;
  };
  events.decided = [this](const capture::Decision& decision) { decided(decision); };
  events.ended = [this](const std::string& folder) { ended(folder); };
  return events;
}

void FlownDay::say_on() {
  const sim::LinePiece piece = stream_.next();
  clock_.at(piece.time, [this, piece] {
    if (piece.kind == sim::LinePiece::Kind::kPluggedIn) receiver_.plug_in();
    receiver_.send(piece.bytes);
    say_on();
  });
}

void FlownDay::decided(const capture::Decision& decision) {
  const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what);
  if (taken == nullptr) return;
  const capture::Target& target = taken->target;
  if (target.reason == capture::Reason::kHeight) flown_.heights_m.push_back(target.height_m);
  if (target.reason == capture::Reason::kAside) ++flown_.aside;
}

void FlownDay::ended(const std::string& folder) {
  flown_.folder = folder;
  hour_.flights.push_back(std::exchange(flown_, {}));
}

// Each trouble in a climb of its own, below the heights to be photographed or among them.
void FlownDay::plan_hour(int hour) {
  const HostTime begin = HostTime{} + std::chrono::hours(hour);
  const auto in_flight = [&](int flight, const std::function<void()>& from,
                             const std::function<void()>& until) {
    const HostTime at = begin + flight * seconds(kFlight_s) + kClimbing;
    clock_.at(at, from);
    clock_.at(at + kTrouble, until);
  };
  const auto nothing = [] {};
  in_flight(
      3, [this] { receiver_.pull(); }, [this] { receiver_.plug_in(); });
  in_flight(
      6, [this] { camera_.unplug(); }, [this] { camera_.plug_in(); });
  in_flight(
      9, [this] { camera_.silence(true); }, [this] { camera_.silence(false); });
  in_flight(
      12, [this] { camera_.break_stream(); }, nothing);
  in_flight(
      15, [this] { disk_.set_capacity(0); },
      [this] { disk_.set_capacity(std::numeric_limits<std::int64_t>::max()); });
  clock_.at(begin + kEndOfHour, [this] { end_hour(); });
}

// As the service manager does, who is shown a sign of life every half of its patience.
void FlownDay::look() {
  const service::Progress::State state = daemon_->progress();
  if (!state.hangs.empty()) hangs_.push_back(state.hangs);
  if (std::exchange(rounds_, state.rounds) == state.rounds) hangs_.emplace_back("no round");
  if (hours_done_ < hours_) clock_.after(kLookEvery, [this] { look(); });
}

void FlownDay::end_hour() {
  hour_.disk_bytes = disk_.used_bytes();
  const auto folders = disk_.list("");
  hour_.folders = folders->size();
  for (const std::string& flight : *folders) {
    if (flight != folders->back()) disk_.take_away(flight);  // the last is open
  }
  FlownHour hour = std::exchange(hour_, {});
  wait_for_other_threads();
  hour.in_use = in_use();
  done_(hours_done_, hour);
  if (++hours_done_ == hours_) {
    daemon_->stop();
  } else {
    plan_hour(hours_done_);
  }
}

}  // namespace plumbline::soak
