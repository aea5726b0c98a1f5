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

#include "drivers/clock.h"
#include "drivers/trigger_line.h"

namespace plumbline::contract {

// A trigger line, and the camera at its far end, which can drive the line in. Time passes only in
// pass().
class TriggerLineBench {
 public:
  virtual ~TriggerLineBench() = default;
  virtual std::string why_not() const { return ""; }  // why it cannot run here
  virtual TriggerLine& line() = 0;
  virtual Clock& clock() = 0;
  virtual void drive(bool active) = 0;
  virtual void pass(std::chrono::nanoseconds time) = 0;
  virtual std::chrono::nanoseconds pulse_width() const = 0;
};

struct TriggerLineMaker {
  std::string name;
  std::function<std::unique_ptr<TriggerLineBench>()> make;
};
inline void PrintTo(const TriggerLineMaker& maker, std::ostream* out) { *out << maker.name; }

// What drivers/trigger_line.h promises.
class TriggerLineContract : public ::testing::TestWithParam<TriggerLineMaker> {
 protected:
  void SetUp() override;
  void listen();
  std::vector<LineEdge> edges() const;
  // Lets time pass until so many edges have come, a second at most.
  void wait_for_edges(std::size_t count);

  std::unique_ptr<TriggerLineBench> bench_ = GetParam().make();
  mutable std::mutex mutex_;
  std::vector<LineEdge> edges_;
};

}  // namespace plumbline::contract
