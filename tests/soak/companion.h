// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "drivers/storage.h"
#include "edge/base/fix_decoder.h"
#include "edge/capture/frame_ring.h"
#include "sim/sim_camera.h"
#include "sim/sim_trigger_line.h"
#include "sim/virtual_clock.h"

namespace plumbline::soak {

// What came and what did not.
struct Tally {
  std::uint64_t fixes = 0;
  std::uint64_t wrong_fixes = 0;  // that nobody said
  std::uint64_t frames = 0;
  std::uint64_t frames_lost = 0;
  std::uint64_t camera_reports = 0;
  std::uint64_t photos = 0;  // taken and stored
  std::uint64_t photos_missed = 0;
  std::uint64_t edges = 0;
  std::uint64_t edges_lost = 0;
  std::string last_fault;  // of the disk
};

// A companion computer that stays on all day: receiver and camera run on, and every hour brings a
// flight with 60 photos and the same troubles after it. Single-threaded, on the virtual clock.
class Companion {
 public:
  // `clock` and `disk` outlive it.
  Companion(sim::VirtualClock& clock, Storage& disk);

  Status switch_on();
  // One hour, after which the disk is empty again and nothing is under way.
  void live_an_hour();

  const Tally& tally() const { return tally_; }

 private:
  void say_next_burst();
  void take(CameraEvent event);
  void take(const GnssFix& fix);
  void fly();
  void shoot();
  void store(const std::string& name, WritableFile& log);
  void suffer();
  void clear_the_disk();
  void pass(std::chrono::nanoseconds time) { clock_.run_until(clock_.now() + time); }

  sim::VirtualClock& clock_;
  Storage& disk_;
  Tally tally_;
  sim::SimCamera camera_;
  capture::FrameRing<Frame> ring_{2};
  std::optional<HostTime> last_frame_;
  std::unique_ptr<FixDecoder> decoder_;
  std::unique_ptr<sim::SimTriggerLine> line_;
  int epoch_ = 0;  // of the hour
};

}  // namespace plumbline::soak
