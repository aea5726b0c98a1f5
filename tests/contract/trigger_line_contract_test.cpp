// SPDX-License-Identifier: MIT
#include "tests/contract/trigger_line_contract.h"

#include <cstdlib>
#include <fstream>
#include <thread>

#include "drivers/gpio/gpio_trigger_line.h"
#include "drivers/patient_line.h"
#include "drivers/posix/system_clock.h"
#include "sim/sim_trigger_line.h"

namespace plumbline::contract {
namespace {

using namespace std::chrono_literals;

class SimBench : public TriggerLineBench {
 public:
  TriggerLine& line() override { return line_; }
  Clock& clock() override { return clock_; }
  void drive(bool active) override { line_.drive(clock_.now(), active); }
  void pass(std::chrono::nanoseconds time) override { clock_.run_until(clock_.now() + time); }
  std::chrono::nanoseconds pulse_width() const override { return 2ms; }

 private:
  sim::VirtualClock clock_{HostTime(100s)};
  sim::SimTriggerLine line_{clock_, 2ms};
};

// The same behind a line that waits for it.
class PatientBench : public SimBench {
 public:
  TriggerLine& line() override { return patient_; }

 private:
  // What stands for the device: the bench's own line, lent.
  class Lent : public TriggerLine {
   public:
    explicit Lent(TriggerLine& line) : line_(line) {}
    ~Lent() override { line_.stop(); }
    Result<Pulse> pulse() override { return line_.pulse(); }
    Status listen(Sink sink) override { return line_.listen(std::move(sink)); }
    void stop() override { line_.stop(); }

   private:
    TriggerLine& line_;
  };

  PatientLine patient_{[this]() -> Result<std::unique_ptr<TriggerLine>> {
                         return {std::make_unique<Lent>(SimBench::line())};
                       },
                       clock()};
};

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

// Lines of gpio-sim, the kernel's own test chip: PLUMBLINE_TEST_GPIO_OUT and _IN name them,
// PLUMBLINE_TEST_GPIO_PULL the file in sysfs that drives the second.
class GpioBench : public TriggerLineBench {
 public:
  GpioBench() {
    if (!why_not().empty()) return;
    gpio::TriggerLineOptions options;
    options.out = gpio::LineSettings{setting("PLUMBLINE_TEST_GPIO_OUT")};
    options.in = gpio::LineSettings{setting("PLUMBLINE_TEST_GPIO_IN")};
    options.pulse_width = 2ms;
    drive(false);
    line_ = gpio::make_trigger_line(options, clock_);
  }

  std::string why_not() const override {
    for (const char* name :
         {"PLUMBLINE_TEST_GPIO_OUT", "PLUMBLINE_TEST_GPIO_IN", "PLUMBLINE_TEST_GPIO_PULL"}) {
      if (setting(name).empty())
        return std::string("no GPIO lines to try: ") + name + " is not set (scripts/bench sets it)";
    }
    return "";
  }
  TriggerLine& line() override {
    if (!line_) {
      ADD_FAILURE() << line_.error().sentence;
      std::abort();
    }
    return **line_;
  }
  Clock& clock() override { return clock_; }
  void drive(bool active) override {
    std::ofstream(setting("PLUMBLINE_TEST_GPIO_PULL"))
        << (active ? "pull-up" : "pull-down") << std::flush;
  }
  void pass(std::chrono::nanoseconds time) override { std::this_thread::sleep_for(time); }
  std::chrono::nanoseconds pulse_width() const override { return 2ms; }

 private:
  posix::SystemClock clock_;
  Result<std::unique_ptr<TriggerLine>> line_ = Error{"not opened"};
};

INSTANTIATE_TEST_SUITE_P(
    TriggerLines, TriggerLineContract,
    ::testing::Values(TriggerLineMaker{"Simulated", [] { return std::make_unique<SimBench>(); }},
                      TriggerLineMaker{"Patient", [] { return std::make_unique<PatientBench>(); }},
                      TriggerLineMaker{"OfThisMachine",
                                       [] { return std::make_unique<GpioBench>(); }}),
    [](const auto& info) { return info.param.name; });

TEST(GpioTriggerLine, SaysWhichLineIsNotThere) {
  const posix::SystemClock clock;
  gpio::TriggerLineOptions options;
  options.out = gpio::LineSettings{"gpiochip77:3"};
  const auto line = gpio::make_trigger_line(options, clock);
  ASSERT_FALSE(line.ok());
  EXPECT_EQ(line.error().sentence,
            "Cannot find the GPIO line 'gpiochip77:3': there is no such chip or line; gpioinfo "
            "lists what there is.");
}

}  // namespace
}  // namespace plumbline::contract
