// SPDX-License-Identifier: MIT
#include "tests/soak/companion.h"

#include <cstdlib>
#include <string_view>
#include <utility>
#include <variant>

#include "edge/gnss/stream_decoder.h"
#include "tests/talk/receiver_talk.h"

namespace plumbline::soak {
namespace {

using std::chrono::milliseconds;
using std::chrono::seconds;

constexpr int kEpochsOfAnHour = 36000;
constexpr int kPhotosOfAFlight = 60;
constexpr milliseconds kEpochInterval{100};

sim::SimCameraOptions camera_options() {
  sim::SimCameraOptions options;
  options.drop_probability = 0.01;
  options.sigma_stamp = milliseconds(1);
  return options;
}

sim::TriggerLineFaults line_faults() {
  sim::TriggerLineFaults faults;
  faults.doubled = 0.05;
  faults.lost = 0.05;
  faults.jitter_sigma = std::chrono::microseconds(50);
  return faults;
}

}  // namespace

Companion::Companion(sim::VirtualClock& clock, Storage& disk)
    : clock_(clock),
      disk_(disk),
      camera_(clock, camera_options()),
      decoder_(gnss::make_fix_decoder([this](const GnssFix& fix, ByteRange) { take(fix); })) {}

Status Companion::switch_on() {
  say_next_burst();
  return camera_.start({}, [this](CameraEvent event) { take(std::move(event)); });
}

void Companion::live_an_hour() {
  const HostTime end = clock_.now() + std::chrono::hours(1);
  fly();
  suffer();
  clear_the_disk();
  clock_.run_until(end);
  ring_.clear();  // two frames lie in one block of a deque or in two, by where it stands
}

// In two pieces, as a serial port hands it over, and cut short once an hour.
void Companion::say_next_burst() {
  clock_.after(kEpochInterval, [this] {
    const std::string burst = talk::positions(epoch_);
    decoder_->feed(std::string_view(burst).substr(0, burst.size() / 2));
    decoder_->feed(std::string_view(burst).substr(burst.size() / 2));
    decoder_->flush();
    if (epoch_ % 600 == 0) decoder_->feed(talk::noise(epoch_));
    if (++epoch_ == kEpochsOfAnHour) {
      epoch_ = 0;
      decoder_->cut();
    }
    say_next_burst();
  });
}

void Companion::take(const GnssFix& fix) {
  ++(talk::was_said(fix) ? tally_.fixes : tally_.wrong_fixes);
}

void Companion::take(CameraEvent event) {
  if (auto* frame = std::get_if<Frame>(&event)) {
    ++tally_.frames;
    const HostTime middle = frame->timing.middle_of_row(0.5 * (frame->image->height_px - 1));
    const auto period = last_frame_ ? middle - *last_frame_ : milliseconds(100);
    last_frame_ = middle;
    ring_.push({middle, period}, std::move(*frame));
  } else if (const auto* lost = std::get_if<FramesLost>(&event)) {
    tally_.frames_lost += lost->count;
  } else if (std::holds_alternative<CameraReport>(event)) {
    ++tally_.camera_reports;
  }
}

void Companion::fly() {
  line_ = std::make_unique<sim::SimTriggerLine>(clock_, milliseconds(10), 1, line_faults());
  const Status listening = line_->listen([this](const LineEvent& event) {
    if (std::holds_alternative<LineEdge>(event)) ++tally_.edges;
    if (const auto* lost = std::get_if<EdgesLost>(&event)) tally_.edges_lost += lost->count;
  });
  auto log = disk_.create("log");
  if (!listening || !log) std::abort();
  for (int photo = 0; photo < kPhotosOfAFlight; ++photo) {
    pass(seconds(20));
    shoot();
    store("photo" + std::to_string(photo), **log);
  }
  line_.reset();
}

void Companion::shoot() {
  ring_.want(clock_.now());
  if (!line_->pulse()) std::abort();
  line_->drive(clock_.now() + milliseconds(5), true);
  line_->drive(clock_.now() + milliseconds(15), false);
  pass(seconds(1));
}

void Companion::store(const std::string& name, WritableFile& log) {
  const auto taken = ring_.take(clock_.now());
  if (!taken) {
    ++tally_.photos_missed;
    return;
  }
  const auto pixels = taken->second.image->bytes;
  const std::string bytes(pixels.begin(), pixels.end());
  const bool stored = publish(disk_, name, bytes).ok() && log.append(name).ok() && log.sync().ok();
  ++(stored ? tally_.photos : tally_.photos_missed);
}

void Companion::suffer() {
  camera_.unplug();
  pass(seconds(5));
  camera_.plug_in();
  pass(seconds(5));
  camera_.silence(true);
  pass(seconds(5));
  camera_.silence(false);
  camera_.break_stream();
  pass(seconds(5));
  const Status refused = publish(disk_, "no_such_folder/photo", "bytes");
  tally_.last_fault = refused ? "" : refused.error().sentence;
}

void Companion::clear_the_disk() {
  const auto names = disk_.list("");
  if (!names) std::abort();
  for (const std::string& name : *names) {
    if (!disk_.remove(name)) std::abort();
  }
  if (!disk_.sync_folder("")) std::abort();
}

}  // namespace plumbline::soak
