// SPDX-License-Identifier: MIT
// How well the kernel stamps edges of a GPIO line, and what a clock fitted to a pulse per second
// makes of it, on gpio-sim: the test makes each edge itself and so knows when it was.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/event_queue.h"
#include "drivers/gpio/gpio_trigger_line.h"
#include "drivers/posix/descriptor.h"
#include "drivers/posix/system_clock.h"
#include "edge/timing/pps_fit.h"

namespace plumbline::contract {
namespace {

using namespace std::chrono_literals;
using Microseconds = std::chrono::duration<double, std::micro>;
using std::chrono::nanoseconds;

constexpr int kOften = 200;
constexpr int kSeconds = 60;
constexpr std::ptrdiff_t kSettled = 20;  // seconds after which a fit is better than its pulses

// No run is like the one before. Of sixty normal errors one is beyond 3 sigmas in every seventh
// run; more than three are in one of 40,000, and one beyond 5.1 in one of 50,000.
constexpr double kRare = 5.1;
constexpr int kMostBeyondThree = 3;

std::string setting(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

struct Statistics {
  double mean_us = 0, sd_us = 0, least_us = 0, median_us = 0, most_us = 0;
  double robust_sd_us = 0;  // 1.4826 times the median distance from the median
};

double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

Statistics statistics(const std::vector<double>& values_us) {
  Statistics of;
  const auto count = static_cast<double>(values_us.size());
  for (const double value : values_us) of.mean_us += value / count;
  double squares = 0;
  for (const double value : values_us) squares += (value - of.mean_us) * (value - of.mean_us);
  of.sd_us = std::sqrt(squares / (count - 1));
  of.least_us = *std::min_element(values_us.begin(), values_us.end());
  of.most_us = *std::max_element(values_us.begin(), values_us.end());
  of.median_us = median(values_us);
  std::vector<double> distances;
  for (const double value : values_us) distances.push_back(std::abs(value - of.median_us));
  of.robust_sd_us = 1.4826 * median(distances);
  return of;
}

void print(const char* what, const Statistics& of) {
  std::printf(
      "%s: mean %.1f us, sd %.1f us (by the median %.1f us), least %.1f, median %.1f, most %.1f\n",
      what, of.mean_us, of.sd_us, of.robust_sd_us, of.least_us, of.median_us, of.most_us);
}

// What the test did to the line, and the kernel's stamp of it.
struct MadeEdge {
  HostTime before;
  HostTime after;
  HostTime stamp;
  nanoseconds delay() const { return stamp - before; }
};

Statistics delays_of(const std::vector<MadeEdge>& edges) {
  std::vector<double> delays_us;
  for (const MadeEdge& edge : edges) delays_us.push_back(Microseconds(edge.delay()).count());
  return statistics(delays_us);
}

// Lines of gpio-sim, as trigger_line_contract_test.cpp has them.
class KernelPulses : public ::testing::Test {
 protected:
  void SetUp() override {
    if (setting("PLUMBLINE_TEST_GPIO_IN").empty() || setting("PLUMBLINE_TEST_GPIO_PULL").empty()) {
      GTEST_SKIP() << "no GPIO line to pulse: PLUMBLINE_TEST_GPIO_IN or _PULL is not set "
                      "(scripts/bench sets them)";
    }
    pull_ = posix::Descriptor(
        ::open(setting("PLUMBLINE_TEST_GPIO_PULL").c_str(), O_WRONLY | O_CLOEXEC));
    drive(false);
    gpio::TriggerLineOptions options;
    options.in = gpio::LineSettings{setting("PLUMBLINE_TEST_GPIO_IN")};
    line_ = gpio::make_trigger_line(options, clock_);
    ASSERT_TRUE(line_.ok()) << line_.error().sentence;
    const Status listening = (*line_)->listen([this](LineEvent event) { events_.push(event); });
    ASSERT_TRUE(listening.ok()) << listening.error().sentence;
  }

  void drive(bool active) {
    const std::string_view word = active ? "pull-up" : "pull-down";
    ASSERT_EQ(::pwrite(pull_.get(), word.data(), word.size(), 0),
              static_cast<ssize_t>(word.size()));
  }

  // The stamp of the next edge, or none within 5 s.
  std::optional<HostTime> next_stamp() {
    std::optional<LineEvent> event = events_.pop();
    while (!event && clock_.wait(signal_, clock_.now() + 5s)) event = events_.pop();
    const LineEdge* edge = event ? std::get_if<LineEdge>(&*event) : nullptr;
    return edge == nullptr ? std::nullopt : std::optional(edge->time);
  }

  // The line made high or low at that time, as near as a waiting program can.
  void make_edge(HostTime time, bool high, std::vector<MadeEdge>& edges) {
    clock_.wait(nothing_, time - 1ms);
    MadeEdge edge;
    while ((edge.before = clock_.now()) < time) {
    }
    drive(high);
    edge.after = clock_.now();
    const auto stamp = next_stamp();
    ASSERT_TRUE(stamp) << "an edge was not reported";
    edge.stamp = *stamp;
    edges.push_back(edge);
  }

  posix::SystemClock clock_;
  Signal signal_;
  Signal nothing_;
  EventQueue<LineEvent> events_{signal_};
  posix::Descriptor pull_;
  Result<std::unique_ptr<TriggerLine>> line_ = Error{"not opened"};
};

TEST_F(KernelPulses, AreStampedWhileTheyAreMade) {
  std::vector<MadeEdge> edges;
  for (int i = 0; i < kOften; ++i) {
    ASSERT_NO_FATAL_FAILURE(make_edge(clock_.now() + 5ms, i % 2 == 0, edges));
  }
  std::vector<double> widths_us;
  for (const MadeEdge& edge : edges) {
    EXPECT_GE(edge.stamp, edge.before);
    EXPECT_LE(edge.stamp, edge.after);
    widths_us.push_back(Microseconds(edge.after - edge.before).count());
  }
  print("from the reading before an edge to its stamp", delays_of(edges));
  print("from the reading before an edge to the one after", statistics(widths_us));
}

// A fit that is told of the kernel's delay as it was measured.
timing::PpsFitOptions told_of(const Statistics& delay) {
  timing::PpsFitOptions options;
  // It adds the scatter that it sees to the delay.
  const double least_us = std::max(0.0, delay.median_us - delay.robust_sd_us);
  options.interrupt = nanoseconds(std::llround(1e3 * least_us));
  options.interrupt_sigma = nanoseconds(std::llround(1e3 * delay.robust_sd_us));
  options.gate = std::max(options.gate, 5 * options.interrupt_sigma);
  return options;
}

// GNSS time begins to count at `origin`; what arrivals alone would say of it is 40 ms wrong.
timing::GnssClock coarse_clock(HostTime origin) {
  timing::GnssClock coarse;
  coarse.host = origin + 40ms;
  coarse.gps = GpsTime(1000s);
  coarse.latency = 80ms;
  coarse.sigma_latency = 30ms;
  return coarse;
}

// Where others are at work on its processor a machine's pace changes, and the delay that was
// measured at the one kind of edges may not be that of the other.
bool are_alike(const Statistics& a, const Statistics& b) {
  const double scatter_us = std::min(a.robust_sd_us, b.robust_sd_us);
  return std::abs(a.median_us - b.median_us) <= scatter_us &&
         std::max(a.robust_sd_us, b.robust_sd_us) <= 2 * scatter_us;
}

// A pulse of half a second each second for a minute. The clock is fitted to the rising edges; the
// kernel's delay and its jitter are measured at the falling ones.
TEST_F(KernelPulses, GiveAClockWithinTheirOwnJitter) {
  std::vector<MadeEdge> rising, falling;
  const HostTime origin = clock_.now() + 20ms;
  for (int second = 0; second < kSeconds; ++second) {
    const HostTime pulse = origin + std::chrono::seconds(second);
    ASSERT_NO_FATAL_FAILURE(make_edge(pulse, true, rising));
    ASSERT_NO_FATAL_FAILURE(make_edge(pulse + 500ms, false, falling));
  }
  const Statistics delay = delays_of(falling);
  print("the kernel's delay at falling edges", delay);
  print("the kernel's delay at rising edges", delays_of(rising));
  if (!are_alike(delay, delays_of(rising))) {
    GTEST_SKIP() << "the machine's pace changed between these edges and those: its delay is not "
                    "known, nor how good a clock is that was told of it. Run it when it is idle";
  }
  timing::PpsFit fit(told_of(delay));
  std::vector<double> errors_us, sigmas_us, errors_in_sigmas;
  for (int second = 0; second < kSeconds; ++second) {
    // The pulse of a receiver is exact: how late the test made it, which it knows, is taken off.
    const HostTime pulse = origin + std::chrono::seconds(second);
    fit.add_edge(pulse + rising[static_cast<std::size_t>(second)].delay());
    const auto clock = fit.estimate(coarse_clock(origin));
    if (!clock) continue;
    const auto shown = clock->gps_of(pulse);
    const nanoseconds error = shown.time - GpsTime(1000s + std::chrono::seconds(second));
    errors_us.push_back(Microseconds(error).count());
    sigmas_us.push_back(std::hypot(Microseconds(shown.sigma_fit).count(),
                                   Microseconds(shown.sigma_latency).count()));
    errors_in_sigmas.push_back(errors_us.back() / sigmas_us.back());
  }
  ASSERT_GE(errors_us.size(), static_cast<std::size_t>(kSeconds) / 2);
  const Statistics in_sigmas = statistics(errors_in_sigmas);
  print("error of the clock", statistics(errors_us));
  print("its stated sigma", statistics(sigmas_us));
  std::printf("error in sigmas: from %.2f to %.2f\n", in_sigmas.least_us, in_sigmas.most_us);
  EXPECT_GE(in_sigmas.least_us, -kRare);
  EXPECT_LE(in_sigmas.most_us, kRare);
  const auto is_beyond = [](double in_sigmas) { return std::abs(in_sigmas) > 3; };
  EXPECT_LE(std::count_if(errors_in_sigmas.begin(), errors_in_sigmas.end(), is_beyond),
            kMostBeyondThree);
  const Statistics settled = statistics({errors_us.begin() + kSettled, errors_us.end()});
  print("after twenty pulses", settled);
  EXPECT_LE(std::hypot(settled.mean_us, settled.sd_us), delays_of(rising).sd_us);
}

}  // namespace
}  // namespace plumbline::contract
