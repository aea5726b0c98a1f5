// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <utility>

#include "edge/capture/capture_plan.h"
#include "edge/capture/decisions.h"
#include "edge/capture/inputs.h"
#include "edge/record/entry.h"

namespace plumbline::service {

// What the daemon is doing, gathered from what happens, as one sentence and as JSON. Any thread.
class StatusBoard {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // Whether photos come as frames of a camera that this computer reads; what begins a flight; and a
  // clock, by which a fix grows old.
  explicit StatusBoard(bool needs_frames = true, const capture::TakeOffOptions& take_off = {},
                       std::function<Time()> now = std::chrono::steady_clock::now)
      : needs_frames_(needs_frames), take_off_(take_off), now_(std::move(now)) {}

  void heard(const capture::Input& input);
  void decided(const capture::Decision& decision);
  void said(const record::Message& message);
  void stored(int number, const std::string& folder);
  void ended(const std::string& folder);
  void advised(const std::string& sentence);
  void measured(const std::string& sentence);
  // How many photos fit on the disk, of how many that a flight as planned takes. With fewer it is
  // not ready, and says so; a drone that takes off all the same is photographed while there is
  // room.
  void space(std::int64_t free_photos, std::int64_t planned_photos);
  // The daemon has ended in good order: nothing that devices said holds any longer.
  void stopped();

  std::uint64_t version() const;  // counts what is to be told at once
  std::string json() const;       // one line, with the time of now and the process
  std::string sentence() const;

 private:
  std::string sentence_locked() const;
  const GnssFix* fix_of_late() const;
  const char* quality() const;
  std::string left_behind(const char* what_then) const;
  std::string waiting() const;
  std::string ready() const;
  std::string flying() const;
  std::string begins_when() const;
  std::string photos() const;
  std::string room() const;
  bool lacks_space() const { return free_photos_ && *free_photos_ < planned_photos_; }
  void changed() { ++version_; }

  const bool needs_frames_;
  const capture::TakeOffOptions take_off_;
  const std::function<Time()> now_;
  mutable std::mutex mutex_;
  std::uint64_t version_ = 0;
  capture::Phase phase_ = capture::Phase::kWaiting;
  std::optional<GnssFix> fix_;
  Time fix_came_;
  std::optional<double> ground_height_m_;
  bool streaming_ = false;
  bool pilot_seen_ = false;
  bool stopped_ = false;
  int taken_ = 0, stored_ = 0, missed_ = 0, marked_ = 0;
  std::optional<capture::PhotoTaken> last_photo_;
  std::map<int, double> left_m_;  // heights gone by without a photo, by their number in the plan
  std::map<std::string, record::Message> last_said_;  // by source
  std::string flight_, last_flight_, advice_, result_;
  std::optional<std::int64_t> free_photos_;
  std::int64_t planned_photos_ = 0;
};

}  // namespace plumbline::service
