// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>

#include "firmware/service/result_figures.h"

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
// more after landing. What it does or fails to do costs no photo. One thread of its own.
class Measurer {
 public:
  struct Measured {
    std::string sentence;
    std::optional<ResultFigures> figures;  // empty where the result does not tell them
  };
  struct Events {
    std::function<void(const Measured& measured)> measured;
    std::function<void(const std::string& sentence)> failed;
  };

  Measurer(const MeasurerOptions& options, Events events);
  ~Measurer();  // stops the process

  void stored(const std::string& flight);
  void ended(const std::string& flight);

 private:
  struct Wish {
    std::string flight;
    int photos = 0;
    bool landed = false;
  };

  void run();
  void measure(const Wish& wish);
  void judge(const std::string& folder, int status, bool was_last_try);
  pid_t spawn(const std::string& flight) const;
  int wait_for(pid_t process, const std::string& flight);
  bool request(const std::string& flight) const;

  MeasurerOptions options_;
  Events events_;
  std::mutex mutex_;
  Wish wish_;
  int measured_photos_ = 0;
  std::string measured_flight_;
  bool failed_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace plumbline::service
