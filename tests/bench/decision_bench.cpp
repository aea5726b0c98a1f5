// SPDX-License-Identifier: MIT
// What a decision costs, and what it is worth: time and allocations of the deciding thread from a
// fix's first byte to the pulse, or to knowing that there is none yet, with every core busy (fails
// where there is an allocation); and the altitudes of exposure beside those of a program that fires
// when a fix has passed the step.
#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "firmware/flight/capture_loop.h"
#include "firmware/flight/recorder.h"
#include "firmware/flight/urgent_thread.h"
#include "sim/sim_disk.h"
#include "tests/flights/capture_flight.h"

namespace {

thread_local long allocations = 0;

}  // namespace

// NOLINTBEGIN(misc-new-delete-overloads): those of arrays and of alignment call these.
void* operator new(std::size_t size) {
  ++allocations;
  if (void* place = std::malloc(size)) return place;
  throw std::bad_alloc();
}
void operator delete(void* place) noexcept { std::free(place); }
void operator delete(void* place, std::size_t /*size*/) noexcept { std::free(place); }
// NOLINTEND(misc-new-delete-overloads)

namespace plumbline {
namespace {

constexpr int kFlights = 20;
constexpr double kSpeeds_m_s[] = {1, 2, 3, 5};

flights::CaptureFlight flight_of(int seed, double climb_m_s) {
  flights::CaptureFlight flight;
  flight.seed = static_cast<std::uint64_t>(seed);
  flight.path.climb_m_s = climb_m_s;
  flight.options.release.release = capture::Release::kPulse;
  flight.receiver.interval = std::chrono::milliseconds(200);
  return flight;
}

// Both cores, as the encoder and the measuring program would have them.
class BusyCores {
 public:
  BusyCores() {
    for (unsigned k = 0; k < std::thread::hardware_concurrency(); ++k) {
      threads_.emplace_back([this] {
        volatile double x = 1;
        while (!stop_) x = x + std::sqrt(x);
      });
    }
  }
  ~BusyCores() {
    stop_ = true;
    for (auto& thread : threads_) thread.join();
  }

 private:
  std::atomic<bool> stop_ = false;
  std::vector<std::thread> threads_;
};

struct Cost {
  std::vector<double> fix_us;  // each
  long allocations = 0;
  bool ran_first = true;
};

// Stands where it is put.
class StandingClock : public Clock {
 public:
  HostTime now() const override { return time; }
  WallReading wall() const override { return wall_at_start; }
  bool wait(Signal& /*signal*/, HostTime /*deadline*/) override { return false; }

  HostTime time;
  WallReading wall_at_start;
};

// The deciding thread's part of a flight that was flown, as fast as it goes: what the devices
// reported is handed to the loop, which hands entries to the recorder.
class DecidingThread {
 public:
  DecidingThread(const flights::CaptureFlight& flight, const flights::CaptureLog& log, Cost& cost)
      : log_(log),
        cost_(cost),
        recorder_(disk_, clock_, std::nullopt, {}, [](const auto&) {}),
        loop_(flight.options, clock_, actions()) {
    const auto& started = log.inputs.front();
    clock_.time = started.now;
    clock_.wall_at_start.wall = std::get<capture::Started>(started.what).wall;
    loop_.begin(std::nullopt);
  }

  void run() {
    const flight::UrgentThread first;
    cost_.ran_first = cost_.ran_first && first.is_allowed();
    for (const capture::Input& input : log_.inputs) {
      clock_.time = input.now;
      hear(input.what);
      if (input.now < written_ + kWriteEvery) continue;
      written_ = input.now;
      recorder_.work();  // another thread's in flight
    }
  }

  int pulses() const { return pulses_; }

 private:
  static constexpr std::chrono::milliseconds kWriteEvery{250};

  void hear(const capture::Happening& what) {
    if (const auto* fix = std::get_if<capture::FixHeard>(&what)) {
      hear_fix(*fix);
    } else if (const auto* pulse = std::get_if<capture::PulsePerSecond>(&what)) {
      loop_.take(flight::PulseLine{LineEdge{pulse->edge, true, 0}});
    } else if (const auto* seen = std::get_if<capture::CameraSeen>(&what)) {
      const auto state = seen->streaming ? CameraState::kStreaming : CameraState::kAbsent;
      loop_.take(CameraEvent(CameraReport{clock_.time, state, ""}));
    } else if (const auto* frame = std::get_if<capture::FrameSeen>(&what)) {
      Frame whole;
      whole.sequence = frame->sequence;
      whole.timing = frame->timing;
      loop_.take(CameraEvent(std::move(whole)));
    } else if (std::holds_alternative<capture::Tick>(what)) {
      loop_.tick();
    }
  }

  void hear_fix(const capture::FixHeard& fix) {
    flight::DeviceEvent bytes = ReceiverEvent(ReceivedBytes{fix.first_byte, sentences_});
    flight::DeviceEvent heard = ReceiverEvent(ReceivedFix{fix.fix, fix.first_byte, clock_.time});
    pulsed_.reset();
    const long before = allocations;
    const auto begun = std::chrono::steady_clock::now();
    loop_.take(std::move(bytes));
    loop_.take(std::move(heard));
    const auto ended = std::chrono::steady_clock::now();
    cost_.allocations += allocations - before;
    cost_.fix_us.push_back(
        std::chrono::duration<double, std::micro>(pulsed_.value_or(ended) - begun).count());
  }

  flight::CaptureActions actions() {
    flight::CaptureActions actions;
    actions.pulse = [this] {
      pulsed_ = std::chrono::steady_clock::now();
      ++pulses_;
    };
    actions.keep = [](int, const Frame&) {};
    actions.record = [this](const record::Entry& entry) { recorder_.record(entry); };
    actions.heard = [](const capture::Input&) {};
    actions.decided = [](const capture::Decision&) {};
    actions.said = [](const record::Message&) {};
    return actions;
  }

  const flights::CaptureLog& log_;
  Cost& cost_;
  StandingClock clock_;
  sim::SimDisk disk_;
  flight::Recorder recorder_;
  flight::CaptureLoop loop_;
  std::string sentences_ = std::string(320, 'x');  // GGA, GST and RMC of an epoch
  std::optional<std::chrono::steady_clock::time_point> pulsed_;
  HostTime written_;
  int pulses_ = 0;
};

int pulses_of(const flights::CaptureLog& log) {
  return static_cast<int>(std::count_if(
      log.decisions.begin(), log.decisions.end(),
      [](const auto& decision) { return std::holds_alternative<capture::Pulse>(decision.what); }));
}

void report(Cost cost) {
  std::sort(cost.fix_us.begin(), cost.fix_us.end());
  const auto at = [&](double share) {
    return cost
        .fix_us[static_cast<std::size_t>(share * static_cast<double>(cost.fix_us.size() - 1))];
  };
  std::printf(
      "first byte to decision, all cores busy%s: median %.1f us, 99 %% %.1f us, longest %.0f us of "
      "%zu\n",
      cost.ran_first ? ", real-time priority" : ", no right to real-time priority", at(0.5),
      at(0.99), at(1), cost.fix_us.size());
  std::printf("allocations: %ld\n", cost.allocations);
}

// Fires when the newest fix is at or above the step; the exposure follows by the camera's delay.
double naive_rms_m(const flights::CaptureFlight& flight, const flights::CaptureLog& log) {
  const sim::ClimbPath path(flight.path, flight.seed);
  const auto& heights_m = flight.options.plan.heights_m;
  std::optional<double> ground_m;
  std::size_t next = 0;
  double squares = 0;
  for (const capture::Input& input : log.inputs) {
    const auto* heard = std::get_if<capture::FixHeard>(&input.what);
    if (heard == nullptr || !heard->fix.height_ellipsoidal_m) continue;
    if (!ground_m) ground_m = heard->fix.height_ellipsoidal_m;
    if (next == heights_m.size() || *heard->fix.height_ellipsoidal_m - *ground_m < heights_m[next])
      continue;
    const double exposed_s = in_seconds(input.now.time_since_epoch()) + flight.camera_delay_s;
    const double off_m = path.at(exposed_s).z() - heights_m[next++];
    squares += off_m * off_m;
  }
  return next > 0 ? std::sqrt(squares / static_cast<double>(next)) : 0;
}

double own_rms_m(const flights::CaptureLog& log) {
  double squares = 0;
  int photos = 0;
  for (const auto& photo : log.photos) {
    if (photo.taken.target.reason != capture::Reason::kHeight || photo.taken.marks.late) continue;
    const double off_m = photo.place_m.z() - photo.taken.target.height_m;
    squares += off_m * off_m;
    ++photos;
  }
  return photos > 0 ? std::sqrt(squares / photos) : 0;
}

int run() {
  Cost cost;
  int lacking = 0;
  std::printf("altitude of exposure about the step, RMS, 5 Hz, pulsed camera\n");
  for (const double climb_m_s : kSpeeds_m_s) {
    double own = 0, naive = 0;
    for (int seed = 1; seed <= kFlights; ++seed) {
      const auto flight = flight_of(seed, climb_m_s);
      const auto log = flights::fly(flight);
      own += std::pow(own_rms_m(log), 2) / kFlights;
      naive += std::pow(naive_rms_m(flight, log), 2) / kFlights;
      const BusyCores busy;
      DecidingThread thread(flight, log, cost);
      thread.run();
      lacking += pulses_of(log) - thread.pulses();
    }
    std::printf("  %g m/s: %.3f m; firing when a fix has passed it: %.3f m (%.0f times)\n",
                climb_m_s, std::sqrt(own), std::sqrt(naive), std::sqrt(naive / own));
  }
  const bool is_good = cost.allocations == 0 && lacking == 0;
  if (lacking != 0) std::printf("pulses that the loop did not give: %d\n", lacking);
  report(std::move(cost));
  return is_good ? 0 : 1;
}

}  // namespace
}  // namespace plumbline

int main() { return plumbline::run(); }
