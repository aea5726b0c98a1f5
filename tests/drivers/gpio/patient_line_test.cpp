// SPDX-License-Identifier: MIT
#include "drivers/patient_line.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <vector>

#include "sim/virtual_clock.h"

namespace plumbline {
namespace {

using namespace std::chrono_literals;
using ::testing::ElementsAre;

// A chip that is plugged in and pulled out.
class Chip {
 public:
  void plug(bool in, const std::string& why = "pulled out") {
    Sink sink;
    {
      const std::lock_guard lock(mutex_);
      in_ = in;
      why_ = why;
      if (!in) ++pulled_;
      if (!in) sink = std::exchange(sink_, nullptr);
    }
    if (sink) sink(LineFault{HostTime{}, why});
  }
  void drive(bool active) {
    const std::lock_guard lock(mutex_);
    if (sink_) sink_(LineEdge{HostTime{}, active, 0});
  }
  bool is_heard() const {
    const std::lock_guard lock(mutex_);
    return sink_ != nullptr;
  }
  int tries() const { return tries_; }

  Result<std::unique_ptr<TriggerLine>> open() {
    const std::lock_guard lock(mutex_);
    ++tries_;
    if (!in_) return Error{why_};
    return std::unique_ptr<TriggerLine>(std::make_unique<Line>(*this));
  }

 private:
  using Sink = TriggerLine::Sink;

  class Line : public TriggerLine {
   public:
    explicit Line(Chip& chip) : chip_(chip), opened_(chip.pulled_) {}
    Result<Pulse> pulse() override {
      const std::lock_guard lock(chip_.mutex_);
      if (!chip_.in_ || chip_.pulled_ != opened_) return Error{chip_.why_};
      return Pulse{};
    }
    Status listen(Sink sink) override {
      const std::lock_guard lock(chip_.mutex_);
      chip_.sink_ = std::move(sink);
      return Done{};
    }
    void stop() override {
      const std::lock_guard lock(chip_.mutex_);
      chip_.sink_ = nullptr;
    }

   private:
    Chip& chip_;
    int opened_;  // after so many pulls: what was opened before one is dead
  };

  mutable std::mutex mutex_;
  bool in_ = false;
  int pulled_ = 0;
  std::string why_ = "not there";
  Sink sink_;
  std::atomic<int> tries_ = 0;
};

class PluggedLine : public testing::Test {
 protected:
  void listen() {
    line_.on_return([this] { keep("there"); });
    ASSERT_TRUE(line_.listen([this](const LineEvent& event) {
      if (const auto* fault = std::get_if<LineFault>(&event)) keep(fault->sentence);
      if (std::holds_alternative<LineEdge>(event)) keep("edge");
    }));
  }
  void keep(const std::string& what) {
    const std::lock_guard lock(mutex_);
    said_.push_back(what);
  }
  // What was said, once it is so much; five seconds at most.
  std::vector<std::string> said(std::size_t count) {
    for (int k = 0; k < 500; ++k) {
      {
        const std::lock_guard lock(mutex_);
        if (said_.size() >= count) return said_;
      }
      std::this_thread::sleep_for(10ms);
    }
    const std::lock_guard lock(mutex_);
    return said_;
  }
  static void wait_for(const std::function<bool()>& done) {
    for (int k = 0; k < 500 && !done(); ++k) std::this_thread::sleep_for(10ms);
  }

  sim::VirtualClock clock_{HostTime(100s)};
  Chip chip_;
  std::mutex mutex_;
  std::vector<std::string> said_;
  PatientLine line_{[this] { return chip_.open(); }, clock_,
                    PatientLineOptions{true, true, 20ms, "Meanwhile none."}};
};

TEST_F(PluggedLine, IsListenedToAtOnceWhereItIsThere) {
  chip_.plug(true);
  listen();
  chip_.drive(true);
  EXPECT_THAT(said(1), ElementsAre("edge"));
  EXPECT_TRUE(line_.pulse());
}

TEST_F(PluggedLine, IsLookedForUntilItIsThereAndSaysOnceWhyItIsNot) {
  listen();
  EXPECT_THAT(said(1), ElementsAre("not there Meanwhile none."));
  const auto pulsed = line_.pulse();
  ASSERT_FALSE(pulsed);
  EXPECT_EQ(pulsed.error().sentence, "not there Meanwhile none.");
  const int tries = chip_.tries();
  wait_for([&] { return chip_.tries() > tries + 3; });
  EXPECT_GT(chip_.tries(), tries + 3);
  chip_.plug(false, "no right to it");
  EXPECT_THAT(said(2), ElementsAre("not there Meanwhile none.", "no right to it Meanwhile none."));
  chip_.plug(true);
  EXPECT_EQ(said(3).back(), "there");
  chip_.drive(true);
  EXPECT_EQ(said(4).back(), "edge");
  EXPECT_TRUE(line_.pulse());
}

TEST_F(PluggedLine, IsTakenUpAgainWhenItWasGone) {
  chip_.plug(true);
  listen();
  chip_.plug(false);
  EXPECT_THAT(said(1), ElementsAre("pulled out Meanwhile none."));
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(said(0).size(), 1u) << "once";
  chip_.plug(true);
  EXPECT_THAT(said(2), ElementsAre("pulled out Meanwhile none.", "there"));
  chip_.drive(true);
  EXPECT_EQ(said(3).back(), "edge");
}

TEST_F(PluggedLine, SaysNothingOnceItIsStopped) {
  listen();
  EXPECT_EQ(said(1).size(), 1u);
  line_.stop();
  chip_.plug(true);
  std::this_thread::sleep_for(100ms);
  EXPECT_FALSE(chip_.is_heard());
  EXPECT_EQ(said(0).size(), 1u);
}

TEST(PatientLine, IsOpenedAnewWhereItsPulsesFail) {
  const sim::VirtualClock clock{HostTime(100s)};
  Chip chip;
  chip.plug(true);
  PatientLine line([&] { return chip.open(); }, clock, {false, true, 20ms, ""});
  ASSERT_TRUE(line.listen([](const LineEvent&) {}));
  EXPECT_TRUE(line.pulse());
  chip.plug(false);
  const auto pulsed = line.pulse();
  ASSERT_FALSE(pulsed);
  EXPECT_EQ(pulsed.error().sentence, "pulled out");
  chip.plug(true);
  for (int k = 0; k < 500 && !line.pulse(); ++k) std::this_thread::sleep_for(10ms);
  EXPECT_TRUE(line.pulse());
  EXPECT_GE(chip.tries(), 2);
}

}  // namespace
}  // namespace plumbline
