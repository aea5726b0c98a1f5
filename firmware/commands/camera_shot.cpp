// SPDX-License-Identifier: MIT
#include "firmware/commands/camera_shot.h"

#include <optional>
#include <utility>

#include "drivers/event_queue.h"
#include "edge/pixels/dng.h"
#include "edge/pixels/pixels.h"

namespace plumbline::commands {
namespace {

// What has come so far.
struct Session {
  const ShotOptions& options;
  std::string model;
  Shot shot;
  std::optional<HostTime> first_frame;
  std::string last_report = "The camera has not answered.";
  bool done = false;

  Status take(CameraEvent event);
  Status take_frame(Frame frame);
  Result<std::vector<std::uint8_t>> file_of(const Frame& frame);
};

Result<std::vector<std::uint8_t>> Session::file_of(const Frame& frame) {
  if (!options.camera.raw) return pixels::jpeg_of(*frame.image, options.quality);
  if (!frame.colour.black) {
    shot.notices.emplace_back(
        "The camera does not say what its samples are without light: the raw file states 0.");
  }
  if (!frame.colour.gains) {
    shot.notices.emplace_back(
        "The camera does not say its white balance: set it in the raw converter.");
  }
  return pixels::dng_of(*frame.image, {model, frame.colour, frame.timing.exposure});
}

Status Session::take(CameraEvent event) {
  if (auto* frame = std::get_if<Frame>(&event)) return take_frame(std::move(*frame));
  if (const auto* report = std::get_if<CameraReport>(&event)) {
    if (report->state == CameraState::kAbsent) return Error{report->sentence};
    last_report = report->sentence;
  }
  if (const auto* notice = std::get_if<CameraNotice>(&event)) {
    shot.notices.push_back(notice->sentence);
  }
  return Done{};
}

Status Session::take_frame(Frame frame) {
  const HostTime start = frame.timing.first_row_start;
  if (!first_frame) first_frame = start;
  if (start - *first_frame < options.settle) return Done{};
  auto file = file_of(frame);
  if (!file) return file.error();
  shot.file = std::move(file).value();
  shot.width_px = frame.image->width_px;
  shot.height_px = frame.image->height_px;
  frame.image.reset();
  shot.frame = std::move(frame);
  done = true;
  return Done{};
}

}  // namespace

Result<Shot> take_shot(Camera& camera, const ShotOptions& options, const WaitForSignal& wait) {
  constexpr std::chrono::milliseconds kSlice{100};
  Signal signal;
  EventQueue<CameraEvent> queue(signal);
  const Result<CameraDescription> described = camera.describe();
  Session session{options, described ? described->name : "camera", {}, std::nullopt};
  const auto sink = [&queue](CameraEvent event) { queue.push(std::move(event)); };
  if (const Status started = camera.start(options.camera, sink); !started) return started.error();
  Status taken = Done{};
  const int slices = static_cast<int>(options.patience / kSlice);
  for (int i = 0; i < slices && !session.done && taken;) {
    auto event = queue.pop();
    if (event) {
      taken = session.take(std::move(*event));
      continue;
    }
    if (!signal.take()) {
      wait(signal, kSlice);
      ++i;
    }
  }
  camera.stop();
  if (!taken) return taken.error();
  if (session.done) return std::move(session.shot);
  return Error{"No photo in " + std::to_string(options.patience / std::chrono::seconds(1)) +
               " s. " + session.last_report};
}

}  // namespace plumbline::commands
