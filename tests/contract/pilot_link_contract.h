// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <functional>
#include <memory>
#include <mutex>
#include <ostream>
#include <string>
#include <vector>

#include "drivers/pilot_link.h"

namespace plumbline::contract {

// What arrived from a link, for a test that looks at it from another thread.
class PilotEvents {
 public:
  void add(const PilotEvent& event);

  template <typename Event>
  std::vector<Event> all() const {
    const std::lock_guard lock(mutex_);
    std::vector<Event> of_kind;
    for (const PilotEvent& event : events_) {
      if (const auto* found = std::get_if<Event>(&event)) of_kind.push_back(*found);
    }
    return of_kind;
  }

  std::size_t count() const;
  bool has(PilotState state, std::size_t since_report) const;

 private:
  mutable std::mutex mutex_;
  std::vector<PilotEvent> events_;
};

struct ShownText {
  PilotSeverity severity = PilotSeverity::kInfo;
  std::string text;
};

// A pilot link, and the vehicle at its far end. Time passes only in pass().
class PilotBench {
 public:
  virtual ~PilotBench() = default;

  virtual PilotLink& link() = 0;
  virtual HostTime now() = 0;
  virtual void pass(std::chrono::nanoseconds time) = 0;

  virtual void plug_in() = 0;  // it is pulled out at first
  virtual void pull() = 0;
  // Whether the link can tell a far end that is pulled out from a silent one.
  virtual bool notices_a_pull() const { return true; }
  // Whether its texts wait for a far end that is not there.
  virtual bool holds_texts_back() const { return true; }

  // What the vehicle says. Roll 0.0125, pitch -0.05.
  virtual void heartbeat(bool armed) = 0;
  virtual void attitude(int time_boot_ms, double yaw_rad) = 0;
  virtual void position(int time_boot_ms, double relative_altitude_m) = 0;
  virtual void ground_station() = 0;  // MAVLink of another
  virtual void noise() = 0;

  // What has reached it up to now.
  virtual std::vector<ShownText> shown() = 0;
  virtual std::size_t heartbeats() = 0;
};

struct PilotLinkMaker {
  std::string name;
  std::function<std::unique_ptr<PilotBench>()> make;
};
inline void PrintTo(const PilotLinkMaker& maker, std::ostream* out) { *out << maker.name; }

// What drivers/pilot_link.h promises.
class PilotLinkContract : public testing::TestWithParam<PilotLinkMaker> {
 protected:
  void TearDown() override { bench_->link().stop(); }

  using Talk = std::function<void()>;

  Status start();
  // Goes on until it holds, with `talk` each tenth of a second; false when it did not in time.
  bool until(const std::function<bool()>& holds, const Talk& talk = nullptr,
             std::chrono::milliseconds at_most = std::chrono::milliseconds(5000));
  void go_on_for(std::chrono::milliseconds time, const Talk& talk = nullptr);
  bool reports(PilotState state, const Talk& talk = nullptr);
  // Started, plugged in, and an autopilot is heard.
  void connect();

  PilotEvents events_;
  std::unique_ptr<PilotBench> bench_ = GetParam().make();
  Talk heartbeats_ = [this] { bench_->heartbeat(true); };
};

}  // namespace plumbline::contract
