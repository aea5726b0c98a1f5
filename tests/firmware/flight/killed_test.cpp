// SPDX-License-Identifier: MIT
// The program is killed in the middle of a flight, on a real disk, and started again.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <string>
#include <thread>

#include "drivers/posix/posix_storage.h"
#include "sim/random.h"
#include "tests/firmware/flight/interrupted_flight.h"

namespace plumbline::flight {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;
using std::chrono::nanoseconds;

constexpr int kKills = PLUMBLINE_SANITIZED ? 20 : 200;

// What the process tells while it lives, in memory that outlives it.
struct Told {
  std::atomic<std::int64_t> now_ns = 0;  // of the drone
  std::atomic<int> stored = 0;           // photos reported, the first `stored` of these
  std::array<std::array<char, 8>, 16> folder{};
  std::array<int, 16> number{};
  std::atomic<bool> is_over = false;
};

class KilledFlight {
 public:
  explicit KilledFlight(std::uint64_t seed) : random_(seed, 73) {
    std::string pattern = (fs::temp_directory_path() / "plumbline-killed-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    void* shared =
        ::mmap(nullptr, sizeof(Told), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    told_ = new (shared) Told;
  }
  ~KilledFlight() {
    ::munmap(told_, sizeof(Told));
    fs::remove_all(folder_);
  }

  // Killed after a share of the time that a whole flight takes; that time where it is not killed.
  nanoseconds fly(std::optional<nanoseconds> killed_after) {
    const auto begun = std::chrono::steady_clock::now();
    const pid_t process = ::fork();
    if (process == 0) be_the_program();
    if (killed_after) {
      std::this_thread::sleep_for(*killed_after);
      ::kill(process, SIGKILL);
    }
    int status = 0;
    ::waitpid(process, &status, 0);
    const auto took = std::chrono::steady_clock::now() - begun;
    EXPECT_TRUE(WIFSIGNALED(status) || told_->is_over);
    return took;
  }

  bool was_in_the_middle() const { return !told_->is_over; }

  void go_on() {
    InterruptedFlight flight;
    for (int k = 0; k < told_->stored; ++k) {
      const auto slot = static_cast<std::size_t>(k);
      flight.reported(told_->folder[slot].data(), told_->number[slot]);
    }
    flight.drone().clock().run_until(HostTime(nanoseconds(told_->now_ns)));
    const auto disk = posix::open_storage(folder_);
    ASSERT_TRUE(disk);
    flight.go_on(**disk, milliseconds(static_cast<int>(random_.uniform(200, 8000))));
  }

 private:
  [[noreturn]] void be_the_program() {
    InterruptedFlight flight;
    const auto disk = posix::open_storage(folder_);
    if (!disk) ::_exit(1);
    SessionEvents events;
    events.heard = [&](const capture::Input& input) {
      told_->now_ns = input.now.time_since_epoch().count();
    };
    events.stored = [&](int number, const std::string& folder) {
      const auto slot = static_cast<std::size_t>(told_->stored.load());
      folder.copy(told_->folder[slot].data(), told_->folder[slot].size() - 1);
      told_->number[slot] = number;
      ++told_->stored;
    };
    Session session(InterruptedFlight::plan(), flight.devices(**disk), events);
    if (!session.start()) ::_exit(1);
    session.run(flight.drone().end());
    session.finish("switched off");
    told_->is_over = true;
    ::_exit(0);
  }

  sim::Random random_;
  std::string folder_;
  Told* told_ = nullptr;
};

TEST(KilledProgram, LosesNothingThatWasStoredAtAnyMoment) {
  const nanoseconds whole = KilledFlight(0).fly(std::nullopt);
  sim::Random random(1, 74);
  int in_the_middle = 0;
  int kills = 0;
  for (; in_the_middle < kKills && kills < 10 * kKills; ++kills) {
    SCOPED_TRACE("kill " + std::to_string(kills));
    KilledFlight flight(random.next());
    flight.fly(nanoseconds(std::llround(random.uniform() * static_cast<double>(whole.count()))));
    in_the_middle += flight.was_in_the_middle() ? 1 : 0;
    flight.go_on();
  }
  std::printf("%d of %d were killed in the middle of a flight of %.0f ms\n", in_the_middle, kills,
              1e-6 * static_cast<double>(whole.count()));
  EXPECT_EQ(in_the_middle, kKills);
}

}  // namespace
}  // namespace plumbline::flight
