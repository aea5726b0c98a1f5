// SPDX-License-Identifier: MIT
#include "drivers/gpio/gpio_trigger_line.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <time.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <thread>
#include <utility>

#include "drivers/gpio/edge_numbering.h"

namespace plumbline::gpio {
namespace {

void sleep_until(HostTime time) {
  const auto since_boot = time.time_since_epoch();
  const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(since_boot);
  const timespec when{static_cast<time_t>(seconds.count()),
                      static_cast<long>((since_boot - seconds).count())};
  while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &when, nullptr) == EINTR) {
  }
}

class GpioTriggerLine : public TriggerLine {
 public:
  GpioTriggerLine(std::unique_ptr<OutputLine> out, std::unique_ptr<InputLine> in,
                  std::chrono::nanoseconds width, const Clock& clock)
      : out_(std::move(out)), in_(std::move(in)), width_(width), clock_(clock) {}

  ~GpioTriggerLine() override {
    GpioTriggerLine::stop();
    if (out_) static_cast<void>(out_->set(false).ok());
  }

  Result<Pulse> pulse() override {
    if (!out_) return Error{"No GPIO line is set for the trigger's output; name one to fire it."};
    const HostTime before = clock_.now();
    if (const Status set = out_->set(true); !set) return set.error();
    const HostTime after = clock_.now();
    sleep_until(after + width_);
    const HostTime end = clock_.now();
    if (const Status set = out_->set(false); !set) return set.error();
    return Pulse{before, after, end - after};
  }

  Status listen(Sink sink) override {
    if (!in_) return Error{"No GPIO line is set for events; name one to listen to it."};
    if (thread_.joinable()) return Error{"The trigger line is listened to already."};
    wake_up_ = ::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK);
    if (wake_up_ < 0) return line_error("listen to", "events", errno);
    forget_what_came_before();
    thread_ = std::thread([this, sink = std::move(sink)] { run(sink); });
    return Done{};
  }

  void stop() override {
    if (!thread_.joinable()) return;
    static_cast<void>(::eventfd_write(wake_up_, 1));
    thread_.join();
    ::close(std::exchange(wake_up_, -1));
  }

 private:
  // The kernel queues edges from the moment the line is taken.
  void forget_what_came_before() {
    pollfd queued{in_->descriptor(), POLLIN, 0};
    while (::poll(&queued, 1, 0) > 0 && in_->read()) {
    }
    numbering_ = EdgeNumbering();
  }

  void run(const Sink& sink) {
    while (true) {
      std::array<pollfd, 2> waited{{{wake_up_, POLLIN, 0}, {in_->descriptor(), POLLIN, 0}}};
      const int ready = ::poll(waited.data(), waited.size(), -1);
      if (ready < 0 && errno == EINTR) continue;
      if (waited[0].revents != 0) return;
      const auto edges = in_->read();
      if (!edges) {
        sink(LineFault{clock_.now(), edges.error().sentence});
        return;
      }
      for (const LineEvent& event : numbering_.number(*edges)) sink(event);
    }
  }

  std::unique_ptr<OutputLine> out_;
  std::unique_ptr<InputLine> in_;
  std::chrono::nanoseconds width_;
  const Clock& clock_;
  EdgeNumbering numbering_;
  int wake_up_ = -1;
  std::thread thread_;
};

}  // namespace

Result<std::unique_ptr<TriggerLine>> make_trigger_line(const TriggerLineOptions& options,
                                                       const Clock& clock) {
  std::unique_ptr<OutputLine> out;
  std::unique_ptr<InputLine> in;
  if (options.out) {
    auto opened = open_output(*options.out);
    if (!opened) return opened.error();
    out = std::move(*opened);
  }
  if (options.in) {
    auto opened = open_input(*options.in);
    if (!opened) return opened.error();
    in = std::move(*opened);
  }
  return std::unique_ptr<TriggerLine>(
      std::make_unique<GpioTriggerLine>(std::move(out), std::move(in), options.pulse_width, clock));
}

}  // namespace plumbline::gpio
