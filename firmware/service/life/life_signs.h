// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <thread>

#include "drivers/signal.h"
#include "edge/record/entry.h"
#include "firmware/service/life/progress.h"
#include "firmware/service/life/service_manager.h"

namespace plumbline::service {

// What is shown to the service manager, and where it is said when something hangs.
struct LifeSources {
  std::function<Progress::State()> progress;
  std::function<std::string()> sentence;  // of the status
  std::function<void(record::Severity, const std::string& source, const std::string& sentence)> say;
};

// Tells the service manager what the daemon does, and that it lives: only after a round of the
// deciding thread since the last time, and only while nothing hangs. One thread of its own, for a
// socket may have to be waited for.
class LifeSigns {
 public:
  // `manager` outlives it, and so does what `sources` reach. Looks every half second by itself.
  LifeSigns(const ServiceManager& manager, LifeSources sources);
  ~LifeSigns();
  LifeSigns(const LifeSigns&) = delete;
  LifeSigns& operator=(const LifeSigns&) = delete;

  // One look, by whoever does without the thread.
  class Look {
   public:
    Look(const ServiceManager& manager, LifeSources sources)
        : manager_(manager), sources_(std::move(sources)) {}
    void now();

   private:
    void tell_what_hangs(const Progress::State& state);
    void show();
    void sent(const Status& status);

    const ServiceManager& manager_;
    LifeSources sources_;
    std::uint64_t rounds_ = 0;
    std::string shown_;
    std::string hangs_;
    bool disk_is_late_ = false;
    bool is_deaf_ = false;  // the manager, and it was said
  };

 private:
  void run();

  Look look_;
  Signal stop_;
  std::thread thread_;
};

}  // namespace plumbline::service
