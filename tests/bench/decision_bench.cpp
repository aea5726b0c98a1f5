// SPDX-License-Identifier: MIT
// What a decision costs, and what it is worth: time and allocations from a fix to what follows from
// it, with every core busy (fails where there is an allocation); and the altitudes of exposure
// beside those of a program that fires when a fix has passed the step.
#include <pthread.h>
#include <sched.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <new>
#include <thread>
#include <vector>

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

// For as long as it lives this thread runs before all others, as the daemon's deciding thread is
// to run; where the system does not allow it, it is said.
class RunsFirst {
 public:
  RunsFirst() { allowed_ = set(SCHED_FIFO, 10); }
  ~RunsFirst() { set(SCHED_OTHER, 0); }
  bool is_allowed() const { return allowed_; }

 private:
  static bool set(int policy, int priority) {
    sched_param parameters{};
    parameters.sched_priority = priority;
    return ::pthread_setschedparam(::pthread_self(), policy, &parameters) == 0;
  }
  bool allowed_ = false;
};

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

// The inputs of a flight again, as fast as they go.
void add_cost(const flights::CaptureFlight& flight, const flights::CaptureLog& log, Cost& cost) {
  const RunsFirst first;
  cost.ran_first = cost.ran_first && first.is_allowed();
  capture::Decider decider(flight.options);
  std::vector<capture::Decision> decisions;
  decisions.reserve(16);
  for (const capture::Input& input : log.inputs) {
    decisions.clear();
    const long before = allocations;
    const auto begun = std::chrono::steady_clock::now();
    decider.take(input, decisions);
    const std::chrono::duration<double, std::micro> took = std::chrono::steady_clock::now() - begun;
    const long made = allocations - before;
    if (!std::holds_alternative<capture::FixHeard>(input.what)) continue;
    cost.fix_us.push_back(took.count());
    cost.allocations += made;
  }
}

void report(Cost cost) {
  std::sort(cost.fix_us.begin(), cost.fix_us.end());
  const auto at = [&](double share) {
    return cost
        .fix_us[static_cast<std::size_t>(share * static_cast<double>(cost.fix_us.size() - 1))];
  };
  std::printf(
      "fix to decision, all cores busy%s: median %.1f us, 99 %% %.1f us, longest %.0f us of %zu\n",
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
  std::printf("altitude of exposure about the step, RMS, 5 Hz, pulsed camera\n");
  for (const double climb_m_s : kSpeeds_m_s) {
    double own = 0, naive = 0;
    for (int seed = 1; seed <= kFlights; ++seed) {
      const auto flight = flight_of(seed, climb_m_s);
      const auto log = flights::fly(flight);
      own += std::pow(own_rms_m(log), 2) / kFlights;
      naive += std::pow(naive_rms_m(flight, log), 2) / kFlights;
      const BusyCores busy;
      add_cost(flight, log, cost);
    }
    std::printf("  %g m/s: %.3f m; firing when a fix has passed it: %.3f m (%.0f times)\n",
                climb_m_s, std::sqrt(own), std::sqrt(naive), std::sqrt(naive / own));
  }
  const bool is_good = cost.allocations == 0;
  report(std::move(cost));
  return is_good ? 0 : 1;
}

}  // namespace
}  // namespace plumbline

int main() { return plumbline::run(); }
