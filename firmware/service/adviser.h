// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <condition_variable>
#include <functional>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "edge/capture/decisions.h"
#include "edge/plan/plan.h"

namespace plumbline::service {

struct Advice {
  std::string sentence;    // what is known, and what to do about what is not
  std::string short_text;  // the same in at most 50 characters, as autopilots show it
};

Advice advice_of(const plan::Summary& summary);

// Asks the planner after every photo what the flight will have measured, on a thread of its own:
// the last photo counts, answers that come too late are not given.
class Adviser {
 public:
  using Sink = std::function<void(const Advice&)>;

  // `sink` is called from the adviser's thread.
  Adviser(const plan::Options& options, Sink sink);
  ~Adviser();

  void decided(const capture::Decision& decision);

 private:
  void run();

  plan::Options options_;
  Sink sink_;
  std::mutex mutex_;
  std::condition_variable changed_;
  std::vector<Eigen::Vector3d> taken_m_;
  bool fixed_ = true;
  bool asked_ = false;
  bool stopping_ = false;
  std::thread thread_;
};

}  // namespace plumbline::service
