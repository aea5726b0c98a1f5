// SPDX-License-Identifier: MIT
#include "firmware/flight/capture_loop.h"

#include <algorithm>
#include <utility>

namespace plumbline::flight {
namespace {

template <class... Cases>
struct Match : Cases... {
  using Cases::operator()...;
};
template <class... Cases>
Match(Cases...) -> Match<Cases...>;

constexpr std::size_t kMostAtOnce = 16;  // decisions that follow from one input

record::Severity severity_of(ReceiverState state) {
  return state == ReceiverState::kPosition ? record::Severity::kInfo : record::Severity::kWarning;
}

record::Severity severity_of(CameraState state) {
  const bool good = state == CameraState::kStreaming || state == CameraState::kStarting;
  return good ? record::Severity::kInfo : record::Severity::kFault;
}

}  // namespace

CaptureLoop::CaptureLoop(const capture::CaptureOptions& options, const Clock& clock,
                         CaptureActions actions)
    : clock_(clock), actions_(std::move(actions)), decider_(options) {
  decisions_.reserve(kMostAtOnce);
}

void CaptureLoop::begin(const std::optional<capture::Resumed>& resumed,
                        const std::deque<capture::Input>& before) {
  const HostTime now = clock_.now();
  const HostTime start = before.empty() ? now : before.front().now;
  const WallTime wall = clock_.wall().wall;
  hear_again({start, capture::Started{wall - (now - start)}});
  for (const capture::Input& input : before) {
    if (const auto* camera = std::get_if<capture::CameraSeen>(&input.what)) {
      streaming_ = camera->streaming;
    }
    hear_again(input);
  }
  if (resumed) hear(*resumed);
}

void CaptureLoop::hear_again(const capture::Input& input) {
  decisions_.clear();
  decider_.take(input, decisions_);
  actions_.record(input);
  for (const auto& decision : decisions_) {
    actions_.record(decision);
    actions_.decided(decision);
  }
}

void CaptureLoop::take(DeviceEvent event) {
  std::visit(Match{[&](ReceiverEvent& receiver) { take_receiver(receiver); },
                   [&](CameraEvent& camera) { take_camera(camera); },
                   [&](PulseLine& line) {
                     const auto* edge = std::get_if<LineEdge>(&line.event);
                     if (edge == nullptr) say_of_line(line.event, "pulse per second");
                     if (edge != nullptr && edge->rising) hear(capture::PulsePerSecond{edge->time});
                   },
                   [&](ShutterLine& line) {
                     const auto* edge = std::get_if<LineEdge>(&line.event);
                     if (edge == nullptr) say_of_line(line.event, "shutter line");
                     if (edge != nullptr && edge->rising) hear(capture::ShutterOpened{edge->time});
                   },
                   [&](PilotEvent& pilot) { take_pilot(pilot); }},
             event);
}

void CaptureLoop::tick() { hear(capture::Tick{}); }

void CaptureLoop::lose(int number) { hear(capture::PhotoLost{number}); }

void CaptureLoop::take_receiver(ReceiverEvent& event) {
  std::visit(Match{[&](ReceivedBytes& bytes) {
                     actions_.record(record::Bytes{bytes.arrival, std::move(bytes.bytes)});
                   },
                   [&](ReceivedFix& fix) {
                     hear(capture::FixHeard{fix.fix, fix.first_byte,
                                            std::exchange(receiver_jumped_, false)});
                   },
                   [&](ReceiverReport& report) {
                     if (report.state == ReceiverState::kJumped) receiver_jumped_ = true;
                     say(severity_of(report.state), "receiver", report.sentence);
                   }},
             event);
}

void CaptureLoop::take_camera(CameraEvent& event) {
  std::visit(
      Match{[&](Frame& frame) {
              if (std::exchange(streaming_, true) != true) hear(capture::CameraSeen{true});
              const capture::FrameSeen seen{frame.sequence, frame.interior_number, frame.timing,
                                            frame.image ? frame.image->height_px : 1};
              frames_.insert_or_assign(frame.sequence, std::move(frame));
              hear(seen);
            },
            [&](FramesLost& lost) {
              say(record::Severity::kWarning, "camera",
                  std::to_string(lost.count) + " frames were lost.");
            },
            [&](CameraReport& report) {
              const bool streaming = report.state == CameraState::kStreaming;
              say(severity_of(report.state), "camera", report.sentence);
              if (streaming == std::exchange(streaming_, streaming)) return;
              if (!streaming) frames_.clear();
              hear(capture::CameraSeen{streaming});
            },
            [&](CameraNotice& notice) { say(record::Severity::kInfo, "camera", notice.sentence); }},
      event);
}

void CaptureLoop::take_pilot(const PilotEvent& event) {
  if (const auto* heartbeat = std::get_if<PilotHeartbeat>(&event)) {
    if (armed_ == heartbeat->armed) return;
    armed_ = heartbeat->armed;
    hear(capture::PilotSeen{heartbeat->armed});
  } else if (const auto* attitude = std::get_if<PilotAttitude>(&event)) {
    actions_.record(*attitude);
  } else if (const auto* position = std::get_if<PilotPosition>(&event)) {
    actions_.record(*position);
    hear(capture::PilotHeightSeen{position->relative_altitude_m, position->velocity_enu_m_s.z()});
  } else if (const auto* report = std::get_if<PilotReport>(&event)) {
    const bool good = report->state == PilotState::kAutopilot;
    if (!good && std::exchange(armed_, std::nullopt)) hear(capture::PilotSeen{});
    say(good ? record::Severity::kInfo : record::Severity::kWarning, "autopilot", report->sentence);
  }
}

void CaptureLoop::say_of_line(const LineEvent& event, const std::string& source) {
  if (const auto* lost = std::get_if<EdgesLost>(&event)) {
    say(record::Severity::kWarning, source, std::to_string(lost->count) + " edges were lost.");
  }
  if (const auto* fault = std::get_if<LineFault>(&event)) {
    say(record::Severity::kFault, source, fault->sentence);
  }
}

void CaptureLoop::say(record::Severity severity, const std::string& source,
                      const std::string& sentence) {
  const record::Message message{clock_.now(), severity, source, sentence};
  actions_.record(message);
  actions_.said(message);
}

// A pulse comes first: writing it down can wait. A frame can wait until it is written down.
void CaptureLoop::hear(capture::Happening what) {
  const capture::Input input{clock_.now(), std::move(what)};
  decisions_.clear();
  decider_.take(input, decisions_);
  for (const auto& decision : decisions_) {
    if (std::holds_alternative<capture::Pulse>(decision.what)) actions_.pulse();
  }
  actions_.record(input);
  actions_.heard(input);
  for (const auto& decision : decisions_) {
    actions_.record(decision);
    actions_.decided(decision);
    if (const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what)) keep(*taken);
  }
  std::erase_if(frames_, [this](const auto& held) { return !decider_.holds(held.first); });
  if (const auto number = std::exchange(without_frame_, std::nullopt)) lose(*number);
}

void CaptureLoop::keep(const capture::PhotoTaken& taken) {
  if (!taken.frame) return;  // the camera keeps its photos itself
  const auto held = frames_.find(*taken.frame);
  if (held == frames_.end()) {
    say(record::Severity::kFault, "camera",
        "The frame of photo " + std::to_string(taken.number) + " was gone when it was chosen.");
    without_frame_ = taken.number;
    return;
  }
  actions_.keep(taken.number, std::move(held->second));
  frames_.erase(held);
}

}  // namespace plumbline::flight
