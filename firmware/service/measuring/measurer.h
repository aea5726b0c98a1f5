// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "firmware/service/disk/found_flight.h"
#include "firmware/service/measuring/result_figures.h"
#include "firmware/service/measuring/result_request.h"

namespace plumbline::service {

struct MeasurerOptions {
  std::string flights;       // the folder of all flights
  std::string program;       // plumbline's path; empty: beside this one, else in PATH
  std::string request_file;  // not empty: asks by this file instead of starting a process
  int memory_mb = 1500;
  std::chrono::seconds longest{900};  // for photos that came, or for the end of a flight
  int first_at = 3;                   // photos
};

// Has the flight measured while it goes on: a process of its own, at idle priority, bounded in
// memory and time, that reads what is durable on the disk and follows the flight until it has
// ended. Started when photos have come; where it died, started again for the next photo, and once
// more after landing. A flight that was found without its result is measured when none is flown.
// What it does or fails to do costs no photo. One thread of its own.
class Measurer {
 public:
  struct Measured {
    std::string flight;  // "0003"
    std::string sentence;
    std::optional<ResultFigures> figures;  // empty where the result does not tell them
    bool was_left = false;                 // a flight of before the program started
  };
  struct Events {
    std::function<void(const Measured& measured)> measured;
    std::function<void(const std::string& flight, const std::string& sentence)> failed;
    std::function<void(const std::string& flight, const std::string& sentence)> begun;  // if left
  };

  Measurer(const MeasurerOptions& options, Events events);
  ~Measurer();  // stops the process

  // At the start, before any other: the newest flight on the disk, and whether it is gone on with.
  void found(const FoundFlight& flight, bool is_under_way);

  void stored(const std::string& flight);
  void ended(const std::string& flight);

 private:
  struct Wish {
    std::string flight;
    int photos = 0;
    bool landed = false;
    bool was_left = false;
  };
  enum class Stop { kNo, kTooLong, kForOthers };

  void run();
  bool is_due() const;
  std::optional<Wish> next() const;
  void measure(const Wish& wish);
  void measure_in_process(const Wish& wish);
  void judge(const Wish& wish, int status);
  void ask(const Wish& wish);
  void look_for_answer();
  pid_t spawn(const std::string& flight) const;
  std::optional<int> wait_for(pid_t process, const Wish& wish);
  Stop must_stop(const Wish& wish, int measured, ResultRequest::Time& rested);
  std::string folder_of(const Wish& wish) const { return options_.flights + "/" + wish.flight; }

  MeasurerOptions options_;
  Events events_;
  std::mutex mutex_;
  Wish wish_;
  std::optional<Wish> left_;
  int measured_photos_ = 0;
  std::string measured_flight_;
  bool again_ = false;  // once more after landing
  bool stopping_ = false;
  ResultRequest request_;  // of the thread
  Wish asked_;
  std::thread thread_;
};

}  // namespace plumbline::service
