// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <ostream>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/gnss_receiver.h"
#include "sim/random.h"

namespace plumbline::contract {

// What arrived from a receiver, for a test that looks at it from another thread.
class ReceiverEvents {
 public:
  void add(ReceiverEvent event);

  std::vector<ReceivedFix> fixes() const;
  std::vector<ReceiverReport> reports() const;
  std::string bytes() const;  // of all ReceivedBytes, in order
  std::size_t count() const;
  bool has(ReceiverState state, std::size_t since_report = 0) const;

 private:
  mutable std::mutex mutex_;
  std::vector<ReceivedFix> fixes_;
  std::vector<ReceiverReport> reports_;
  std::string bytes_;
  std::size_t count_ = 0;
};

// One implementation of GnssReceiver, and the far end of its line. Time passes only in pass().
class ReceiverBench {
 public:
  virtual ~ReceiverBench() = default;

  virtual GnssReceiver& receiver() = 0;
  virtual ReceiverEvents& events() = 0;
  virtual HostTime now() = 0;

  virtual void plug_in() = 0;  // it is pulled out at first
  virtual void pull() = 0;
  virtual void send(std::string_view bytes) = 0;

  // Lets so much time pass; a bench of real time may return earlier when something arrived.
  virtual void pass(std::chrono::nanoseconds time) = 0;
};

using MakeReceiverBench = std::function<std::unique_ptr<ReceiverBench>()>;

struct NamedReceiverBench {
  std::string name;        // letters only
  MakeReceiverBench make;  // empty where it cannot run here
  std::string why_not;     // then
};

inline void PrintTo(const NamedReceiverBench& bench, std::ostream* out) { *out << bench.name; }

// The contract of drivers/gnss_receiver.h as tests, for any bench.
class GnssReceiverContract : public testing::TestWithParam<NamedReceiverBench> {
 protected:
  void SetUp() override;
  void TearDown() override;

  using Talk = std::function<std::string(int epoch)>;

  Status start();
  // Goes on until it holds, with a burst of `talk` each tenth of a second; false when it did not
  // within `at_most`.
  bool until(const std::function<bool()>& holds, std::chrono::milliseconds at_most,
             const Talk& talk = nullptr);
  void go_on_for(std::chrono::milliseconds time, const Talk& talk = nullptr);
  bool reports(ReceiverState state, const Talk& talk = nullptr);
  bool fix_comes(const Talk& talk);

  ReceiverEvents& events() { return bench_->events(); }

  std::unique_ptr<ReceiverBench> bench_;
  int epoch_ = 0;
  HostTime next_burst_;
};

}  // namespace plumbline::contract
