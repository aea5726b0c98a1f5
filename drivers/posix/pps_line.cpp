// SPDX-License-Identifier: MIT
#include "drivers/posix/pps_line.h"

#include <atomic>
#include <chrono>
#include <thread>
#include <utility>

namespace plumbline::posix {
namespace {

using std::chrono::nanoseconds;

// stop() waits so long at most: the kernel's wait cannot be ended from outside.
constexpr std::chrono::milliseconds kPatience{100};
constexpr std::int64_t kSlewDivisor = 2000;  // 500 ppm

nanoseconds offset(const WallReading& reading) {
  return reading.wall.time_since_epoch() - reading.host.time_since_epoch();
}

class PpsLine : public TriggerLine {
 public:
  PpsLine(std::unique_ptr<PpsSource> source, const Clock& clock)
      : source_(std::move(source)), clock_(clock) {}
  ~PpsLine() override { PpsLine::stop(); }

  Result<Pulse> pulse() override {
    return Error{"A PPS device has no output; name a GPIO line to fire the trigger."};
  }

  Status listen(Sink sink) override {
    if (thread_.joinable()) return Error{"The PPS device is listened to already."};
    const WallReading before = clock_.wall();
    const auto first = source_->wait({});
    if (!first) return first.error();
    stopping_ = false;
    thread_ = std::thread([this, before, pulses = first->pulses, sink = std::move(sink)] {
      run(before, pulses, sink);
    });
    return Done{};
  }

  void stop() override {
    stopping_ = true;
    if (thread_.joinable()) thread_.join();
  }

 private:
  // A pulse that comes between a count and the reading after it is found by the next count only, so
  // that it may lie before the last reading: never before the one before that.
  void run(WallReading before, std::uint32_t pulses, const Sink& sink) {
    WallReading between = before;
    while (!stopping_) {
      const auto count = source_->wait(kPatience);
      const WallReading after = clock_.wall();
      if (!count) {
        sink(LineFault{after.host, count.error().sentence});
        return;
      }
      const std::uint32_t fresh = count->pulses - pulses;
      if (fresh > 0 && !stopping_) hand_on(fresh, host_time_of(count->last, before, after), sink);
      pulses = count->pulses;
      before = std::exchange(between, after);
    }
  }

  // Of several fresh pulses only the last one's time is known.
  void hand_on(std::uint32_t fresh, std::optional<HostTime> time, const Sink& sink) {
    lost_ += time ? fresh - 1 : fresh;
    if (!time) return;
    next_ += lost_;
    if (lost_ > 0) sink(EdgesLost{*time, lost_});
    lost_ = 0;
    sink(LineEdge{*time, true, next_++});
  }

  std::unique_ptr<PpsSource> source_;
  const Clock& clock_;
  std::atomic<bool> stopping_ = false;
  std::uint64_t next_ = 0;  // of the thread, while there is one
  std::uint64_t lost_ = 0;
  std::thread thread_;
};

}  // namespace

std::optional<HostTime> host_time_of(WallTime stamp, const WallReading& before,
                                     const WallReading& after) {
  const nanoseconds doubt =
      before.spread + after.spread + (after.host - before.host) / kSlewDivisor;
  if (std::chrono::abs(offset(after) - offset(before)) > doubt) return std::nullopt;
  if (stamp < before.wall - doubt || stamp > after.wall + doubt) return std::nullopt;
  return after.host - (after.wall - stamp);
}

std::unique_ptr<TriggerLine> make_pps_line(std::unique_ptr<PpsSource> source, const Clock& clock) {
  return std::make_unique<PpsLine>(std::move(source), clock);
}

Result<std::unique_ptr<TriggerLine>> open_pps_line(const std::string& path, const Clock& clock) {
  auto source = open_pps_source(path);
  if (!source) return source.error();
  return make_pps_line(std::move(*source), clock);
}

}  // namespace plumbline::posix
