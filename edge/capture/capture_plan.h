// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <vector>

#include "edge/timing/gnss_clock.h"

namespace plumbline::capture {

using std::chrono::nanoseconds;

enum class Direction { kUp, kDown, kBoth };

// What is to be photographed. Heights are above the take-off point, metres.
struct CapturePlan {
  std::vector<double> heights_m = {30, 35, 40, 45, 50, 55, 60,
                                   65, 70, 75, 80, 85, 90};  // ascending
  Direction direction = Direction::kUp;
  // A photo so far beside the last one, once the lowest height is reached: the side-step.
  std::optional<double> aside_m = 5;
  int most_aside = 12;  // in one flight: the way home is none
  // Grid flights, above `grid_from_m`: by time, by distance flown over ground, or both.
  std::optional<nanoseconds> every;
  std::optional<double> every_m;
  double grid_from_m = 20;
  // Without usable height it goes on by the last climb rate for so long, and then by time.
  nanoseconds reckon_for = std::chrono::seconds(5);
  std::optional<nanoseconds> blind_every = std::chrono::seconds(2);
};

// How a photo is taken.
enum class Release {
  kNearestFrame,  // the camera runs freely: of its frames the nearest is kept
  kPulse          // a pulse on the trigger line releases it, some time later
};

struct ReleaseOptions {
  Release release = Release::kNearestFrame;
  // From pulse to the middle of the exposure, until it is known from the first ones.
  nanoseconds delay = std::chrono::milliseconds(100);
  // Whether a frame or an edge of the shutter says when the exposure was; else it is assumed.
  bool is_answered = true;
  int test_pulses = 3;  // on the ground, to learn it
  nanoseconds longest_delay =
      std::chrono::milliseconds(800);  // an exposure later than this is none
};

// What tells the ground from the air.
enum class TakeOffBy {
  kHeight,           // the receiver
  kArmed,            // the autopilot: its motors may turn
  kRelativeAltitude  // the autopilot's height above where it was armed
};

// When a flight begins and ends. An autopilot that is not heard is replaced by the receiver.
struct TakeOffOptions {
  TakeOffBy by = TakeOffBy::kHeight;
  double rise_m = 3;                                 // above the ground, and three sigmas,
  nanoseconds rise_lasts = std::chrono::seconds(2);  // for so long
  double landed_below_m = 2;
  nanoseconds landed_lasts = std::chrono::seconds(5);
};

// A pilot who pauses for a photo gets it when the drone has come to rest.
struct StillnessOptions {
  double paused_below_m_s = 0.25;  // climb rate
  nanoseconds paused_after = std::chrono::seconds(1);
  double within_m = 0.5;          // of a height, when paused
  double still_below_m_s = 0.15;  // in any direction
  nanoseconds still_for = std::chrono::milliseconds(500);
  nanoseconds wait_at_most = std::chrono::seconds(3);
};

struct CaptureOptions {
  CapturePlan plan;
  timing::Latency receiver_latency;  // the least; pulses per second do without
  ReleaseOptions release;
  TakeOffOptions take_off;
  StillnessOptions stillness;
};

}  // namespace plumbline::capture
