// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "drivers/storage.h"
#include "edge/capture/frame_ring.h"
#include "edge/timing/antenna_predictor.h"
#include "edge/timing/clock_fit.h"
#include "sim/gnss_stream.h"
#include "sim/sim_camera.h"
#include "sim/sim_receiver.h"
#include "sim/sim_trigger_line.h"
#include "sim/virtual_clock.h"

namespace plumbline::soak {

// What came and what did not.
struct Tally {
  std::uint64_t fixes = 0;        // with a position
  std::uint64_t wrong_fixes = 0;  // ten sigmas off the truth
  std::uint64_t receiver_reports = 0;
  std::uint64_t frames = 0;
  std::uint64_t frames_lost = 0;
  std::uint64_t camera_reports = 0;
  std::uint64_t photos = 0;     // taken and stored
  std::uint64_t unstored = 0;   // taken, and not stored
  std::uint64_t unplaced = 0;   // stored, and it is not known where they were taken
  std::uint64_t misplaced = 0;  // five sigmas off the truth
  std::uint64_t edges = 0;
  std::uint64_t edges_lost = 0;
  std::string last_fault;  // of the disk
};

// A companion computer that stays on all day with what flies: receiver, clock fit, predictor,
// camera, frame ring, trigger line and disk. The drone goes up and down once a minute and a photo
// is taken where it rises through a height; every hour brings the same troubles. Single-threaded,
// on the virtual clock.
class Companion {
 public:
  // `clock` and `disk` outlive it. Receiver and camera say what they say for `hours`.
  Companion(sim::VirtualClock& clock, Storage& disk, int hours);

  Status switch_on();
  // One hour, after which the disk is empty again and nothing is under way.
  void live_an_hour();

  const Tally& tally() const { return tally_; }

 private:
  void say_on();
  void take(const ReceiverEvent& event);
  void take(const ReceivedFix& received);
  void take(CameraEvent event);
  void foresee(GpsTime newest);
  void shoot(HostTime instant);
  void store(HostTime middle, const Frame& frame);
  void judge_place(HostTime middle);
  void schedule_troubles();
  void open_flight();
  void clear_the_disk();

  sim::VirtualClock& clock_;
  Storage& disk_;
  Tally tally_;
  sim::GnssStream stream_;
  sim::SimReceiver receiver_;
  sim::SimCamera camera_;
  timing::ClockFit fit_;
  timing::AntennaPredictor antenna_;
  capture::FrameRing<Frame> ring_{2};
  std::optional<HostTime> last_frame_;
  std::optional<HostTime> last_shot_;
  std::unique_ptr<sim::SimTriggerLine> line_;
  std::unique_ptr<WritableFile> log_;
  int photo_ = 0;  // of the hour
};

}  // namespace plumbline::soak
