// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "drivers/camera.h"
#include "drivers/clock.h"
#include "drivers/gnss_receiver.h"
#include "drivers/pilot_link.h"
#include "drivers/trigger_line.h"
#include "edge/capture/decider.h"
#include "edge/record/entry.h"

namespace plumbline::flight {

// Which of the two uses an input line has.
struct PulseLine {
  LineEvent event;
};
struct ShutterLine {
  LineEvent event;
};

// Everything that devices report to the deciding thread.
using DeviceEvent = std::variant<ReceiverEvent, CameraEvent, PulseLine, ShutterLine, PilotEvent>;

// What the deciding thread sets in motion. None of these may wait for a device.
struct CaptureActions {
  std::function<void()> pulse;                            // of the trigger line
  std::function<void(int number, Frame frame)> keep;      // encode and store
  std::function<void(const record::Entry&)> record;       // to the journal
  std::function<void(const capture::Input&)> heard;       // for status
  std::function<void(const capture::Decision&)> decided;  // for status and advice
  std::function<void(const record::Message&)> said;       // in words
};

// Joins devices and decisions: translates what devices report into inputs, hands them to the
// Decider, records both, and carries out what is decided. Holds the frames that may still be
// wanted. One thread.
class CaptureLoop {
 public:
  // `clock` outlives it.
  CaptureLoop(const capture::CaptureOptions& options, const Clock& clock, CaptureActions actions);

  // The first inputs of the flight. `before` was heard on the ground and belongs to it: it is heard
  // again, and what followed from it then is not carried out again.
  void begin(const std::optional<capture::Resumed>& resumed,
             const std::deque<capture::Input>& before = {});

  void take(DeviceEvent event);
  void tick();            // when due() has come
  void lose(int number);  // a photo that was handed to `keep`
  HostTime due() const { return decider_.due(); }

  const capture::Decider& decider() const { return decider_; }
  bool has_landed() const { return decider_.phase() == capture::Phase::kLanded; }

 private:
  void hear(capture::Happening what);
  void hear_again(const capture::Input& input);
  void keep(const capture::PhotoTaken& taken);
  void take_receiver(ReceiverEvent& event);
  void take_camera(CameraEvent& event);
  void take_pilot(const PilotEvent& event);
  void say(record::Severity severity, const std::string& source, const std::string& sentence);
  void say_of_line(const LineEvent& event, const std::string& source);

  const Clock& clock_;
  CaptureActions actions_;
  capture::Decider decider_;
  std::map<std::uint64_t, Frame> frames_;  // held, by sequence
  std::vector<capture::Decision> decisions_;
  bool receiver_jumped_ = false;
  std::optional<bool> streaming_;  // unknown to a loop that begins between two frames
  std::optional<bool> armed_;
  std::optional<int> without_frame_;  // the photo
};

}  // namespace plumbline::flight
