// SPDX-License-Identifier: MIT
// The battery is pulled in the middle of a flight, and put back; the disk keeps of unsynced data
// whatever it likes (sim/sim_disk.h).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <string>

#include "sim/random.h"
#include "sim/sim_disk.h"
#include "tests/firmware/flight/interrupted_flight.h"

namespace plumbline::flight {
namespace {

using std::chrono::milliseconds;
using std::chrono::nanoseconds;
using std::chrono::seconds;

constexpr int kMoments = PLUMBLINE_SANITIZED ? 100 : 2000;  // some ten times slower there

// When power goes: at a time, or with an operation of the disk after it.
struct Cut {
  HostTime after;
  std::optional<std::uint64_t> operation;  // of those to come
  std::uint64_t seed = 1;                  // of what the disk keeps
  nanoseconds off = seconds(2);
};

class CutFlight {
 public:
  explicit CutFlight(const Cut& cut) : cut_(cut), random_(cut.seed, 71), disk_(new sim::SimDisk) {}

  void fly() {
    until_the_cut();
    disk_ = disk_->after_power_cut(random_);
    flight_.go_on(*disk_, cut_.off);
  }

 private:
  SessionEvents events(Session*& session) {
    SessionEvents events;
    events.stored = [this](int number, const std::string& folder) {
      flight_.reported(folder, number);
    };
    // The disk says nothing else than that it is off.
    events.said = [&session](const record::Message& said) {
      if (said.source == "disk" && said.severity == record::Severity::kFault) session->stop();
    };
    return events;
  }

  void until_the_cut() {
    Session* running = nullptr;
    if (cut_.operation && cut_.after == HostTime{}) {
      disk_->fail(*cut_.operation, sim::DiskFault::kPowerCut);
    }
    flights::Drone& drone = flight_.drone();
    Session session(InterruptedFlight::plan(), flight_.devices(*disk_), events(running));
    running = &session;
    if (!session.start()) return;
    session.run(cut_.operation ? std::max(cut_.after, drone.clock().now()) : cut_.after);
    if (!cut_.operation) return;
    if (cut_.after != HostTime{}) {
      disk_->fail(disk_->operations() + *cut_.operation, sim::DiskFault::kPowerCut);
    }
    session.run(drone.end());
  }

  Cut cut_;
  sim::Random random_;
  InterruptedFlight flight_;
  std::unique_ptr<sim::SimDisk> disk_;
};

std::uint64_t operations_of_a_flight() {
  InterruptedFlight flight;
  sim::SimDisk disk;
  Session session(InterruptedFlight::plan(), flight.devices(disk), {});
  EXPECT_TRUE(session.start());
  session.run(flight.drone().end());
  session.finish("switched off");
  EXPECT_EQ(recorded_flight(disk, "0001").stored.size(), 4u);  // three heights and a side-step
  return disk.operations();
}

TEST(PowerCut, LosesNothingThatWasStoredWhateverTheDiskWasDoing) {
  const std::uint64_t operations = operations_of_a_flight();
  for (std::uint64_t k = 0; k < operations; ++k) {
    SCOPED_TRACE("cut at operation " + std::to_string(k) + " of " + std::to_string(operations));
    CutFlight({HostTime{}, k, k, seconds(2)}).fly();
  }
}

TEST(PowerCut, LosesNothingThatWasStoredAtAnyMoment) {
  const double end_s =
      std::chrono::duration<double>(InterruptedFlight().drone().end() - HostTime{}).count();
  sim::Random random(1, 72);
  for (int moment = 0; moment < kMoments; ++moment) {
    Cut cut;
    cut.after = HostTime(nanoseconds(std::llround(1e9 * random.uniform(0, end_s))));
    if (random.uniform() < 0.5) cut.operation = random.next() % 12;
    cut.seed = random.next();
    cut.off = milliseconds(static_cast<int>(random.uniform(200, 8000)));
    SCOPED_TRACE("moment " + std::to_string(moment));
    CutFlight(cut).fly();
  }
}

}  // namespace
}  // namespace plumbline::flight
