// SPDX-License-Identifier: MIT
#include "firmware/commands/gnss_live.h"

#include <pthread.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <ctime>
#include <string>
#include <utility>

#include "drivers/event_queue.h"
#include "firmware/commands/arrival_statistics.h"
#include "firmware/commands/gnss_output.h"

namespace plumbline::commands {
namespace {

constexpr std::chrono::milliseconds kLongestWait{100};

// Holds SIGINT and SIGTERM back from this thread and those it starts, to be asked for.
class EndSignals {
 public:
  EndSignals() {
    sigemptyset(&signals_);
    sigaddset(&signals_, SIGINT);
    sigaddset(&signals_, SIGTERM);
    ::pthread_sigmask(SIG_BLOCK, &signals_, &before_);
  }
  ~EndSignals() { ::pthread_sigmask(SIG_SETMASK, &before_, nullptr); }
  EndSignals(const EndSignals&) = delete;
  EndSignals& operator=(const EndSignals&) = delete;

  bool came() const {
    const timespec at_once{};
    return ::sigtimedwait(&signals_, nullptr, &at_once) > 0;
  }

 private:
  sigset_t signals_{};
  sigset_t before_{};
};

std::string decimal(double value, int digits) {
  char text[32];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}

std::string sigmas_of(const GnssFix& fix) {
  std::string text = "sigma";
  for (int axis = 0; axis < 3; ++axis) {
    const auto sigma = sigma_m(fix, axis);
    text += sigma ? " " + decimal(*sigma, 3) : " -";
  }
  return text + " m";
}

// The table, and on a terminal the line below it that is written anew each time.
class LiveView {
 public:
  LiveView(GnssReceiver& receiver, bool json)
      : receiver_(receiver), json_(json), status_(!json && ::isatty(STDOUT_FILENO) == 1) {}

  void show(const ReceiverEvent& event) {
    if (const auto* fix = std::get_if<ReceivedFix>(&event)) show_fix(*fix);
    if (const auto* report = std::get_if<ReceiverReport>(&event)) show_report(*report);
  }

  void end() {
    clear_status();
    const ReceiverCounters all = receiver_.counters();
    print_counters({all.bytes, all.sentences, all.bad_checksum, all.malformed, all.epochs},
                   all.reconnections, json_);
  }

 private:
  void show_fix(const ReceivedFix& fix) {
    clear_status();
    if (!json_ && std::exchange(first_, false)) print_table_head();
    print_fix(fix.fix, json_);
    arrivals_.add(fix);
    last_ = fix.fix;
    write_status();
    std::fflush(stdout);
  }

  void show_report(const ReceiverReport& report) {
    clear_status();
    std::fflush(stdout);
    std::fprintf(stderr, "%s\n", report.sentence.c_str());
    write_status();
    std::fflush(stdout);
  }

  void clear_status() const {
    if (status_) std::printf("\r\x1b[K");
  }

  void write_status() const {
    if (status_) std::printf("%s", status_text().c_str());
  }

  std::string status_text() const {
    const ReceiverCounters counters = receiver_.counters();
    std::string text = name_of(last_.quality) + ", " + sigmas_of(last_);
    if (last_.satellites) text += ", " + std::to_string(*last_.satellites) + " satellites";
    if (const auto rate = arrivals_.rate_hz()) text += ", " + decimal(*rate, 1) + " Hz";
    if (const auto spread = arrivals_.latency_spread_ms()) {
      text += ", latency within " + decimal(*spread, 0) + " ms";
    }
    return text + ", " + std::to_string(counters.bad_checksum + counters.malformed) + " errors, " +
           std::to_string(counters.reconnections) + " reconnections";
  }

  GnssReceiver& receiver_;
  bool json_;
  bool status_;
  bool first_ = true;
  GnssFix last_;
  ArrivalStatistics arrivals_;
};

}  // namespace

Status show_live(GnssReceiver& receiver, Clock& clock, bool json) {
  const EndSignals end;
  Signal arrived;
  EventQueue<ReceiverEvent> events(arrived);
  const Status started =
      receiver.start([&events](ReceiverEvent event) { events.push(std::move(event)); });
  if (!started) return started;
  LiveView view(receiver, json);
  while (!end.came()) {
    clock.wait(arrived, clock.now() + kLongestWait);
    while (const auto event = events.pop()) view.show(*event);
  }
  receiver.stop();
  while (const auto event = events.pop()) view.show(*event);
  view.end();
  return Done{};
}

}  // namespace plumbline::commands
