// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "firmware/service/measuring/result_figures.h"

namespace plumbline::service {

// Asks a service to measure a flight, by a file that holds the flight's path, and sees by
// FLIGHT/result/summary.json what has come of it: `plumbline measure` puts that in place whole.
class ResultRequest {
 public:
  using Time = std::chrono::steady_clock::time_point;

  // `file`: the request's. `longest`: how long a result may take.
  ResultRequest(std::string file, std::chrono::seconds longest)
      : file_(std::move(file)), longest_(longest) {}

  // Of `flight` (its folder), which has so many photos. Fails where the file cannot be written.
  bool ask(const std::string& flight, int photos, Time now);

  struct Answer {
    bool good = true;
    bool is_last = false;  // none is awaited any longer
    std::string sentence;
    std::optional<ResultFigures> figures;
  };
  // A result that is new since it was asked for or since the last one; or that none came in time.
  std::optional<Answer> answer(Time now);

 private:
  using Stamp =
      std::optional<std::pair<ino_t, std::int64_t>>;  // tells a file from its next version

  static Stamp stamp_of(const std::string& flight);
  Answer read() const;

  std::string file_;
  std::chrono::seconds longest_;
  bool is_open_ = false;
  std::string flight_;
  int photos_ = 0;
  Stamp seen_;
  Time asked_;  // when it was due since
};

}  // namespace plumbline::service
