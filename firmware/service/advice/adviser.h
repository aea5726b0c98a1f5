// SPDX-License-Identifier: MIT
#pragma once

#include <condition_variable>
#include <functional>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "edge/base/result.h"
#include "edge/capture/capture_plan.h"
#include "edge/capture/decisions.h"
#include "edge/geodesy/local_frame.h"
#include "edge/plan/plan.h"
#include "firmware/config/config.h"
#include "firmware/service/advice/flown_photos.h"

namespace plumbline::service {

struct Advice {
  std::string sentence;    // what is known, and what to do about what is not
  std::string short_text;  // the same in at most 50 characters, as autopilots show it
};

// What the planner was asked after a photo, and says.
struct Outlook {
  plan::Summary flight;                 // with the photos to come, if there are any
  std::optional<plan::Prediction> now;  // while there are: what the photos taken tell
  bool ends_at_top = true;              // else it ends with photos on the way down
  int photos = 0;                       // that were taken
  int without_fix = 0;                  // of those
};

Advice advice_of(const Outlook& outlook);

struct AdviserOptions {
  plan::Options plan;
  capture::CapturePlan capture;
  double latency_sigma_s = 0;  // of the receiver; 0: pulses per second do without
};

// As configured. The camera is that of camera.calibration with all that the file knows of it, else
// a usual one; changes that the capture plan would not photograph are out of the question. Fails
// where the calibration cannot be read, or is for pictures of another size.
Result<AdviserOptions> adviser_options(const config::Config& config);

// Empty where nothing can be told yet. Under a second.
std::optional<Advice> advise(const std::vector<FlownPhoto>& photos, const AdviserOptions& options);

// Asks the planner after every photo what the flight will have measured, on a thread of its own:
// the last photo counts, answers that come too late are not given.
class Adviser {
 public:
  using Sink = std::function<void(const Advice&)>;

  // `sink` is called from the adviser's thread.
  Adviser(AdviserOptions options, Sink sink);
  ~Adviser();

  // Of the flight that goes on after the program was started anew in the air. Before its first
  // decision.
  void remember(std::vector<FlownPhoto> photos);

  // `frame` is that in which places of this run of the program are given.
  void decided(const capture::Decision& decision, const std::optional<geodesy::LocalFrame>& frame);

 private:
  void run();

  AdviserOptions options_;
  Sink sink_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<FlownPhoto> earlier_;
  std::vector<FlownPhoto> photos_;
  bool asked_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace plumbline::service
