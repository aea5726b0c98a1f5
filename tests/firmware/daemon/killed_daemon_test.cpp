// SPDX-License-Identifier: MIT
// The daemon itself is killed again and again in one flight, and started anew as its service does.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cstdlib>
#include <functional>
#include <memory>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <thread>
#include <utility>

#include "drivers/posix/system_clock.h"
#include "edge/geodesy/local_frame.h"
#include "sim/gnss_stream.h"
#include "sim/live_port.h"
#include "sim/random.h"
#include "tests/firmware/daemon/benched_daemon.h"

namespace plumbline::acceptance {
namespace {

using namespace std::chrono_literals;

// The simulated ground takes seconds to be made at each start, and one to be painted for a photo.
constexpr int kKills = 3;
constexpr double kShortestLife_s = 1, kLongestLife_s = 6;
constexpr double kFirst_m = 10, kLast_m = 26, kStep_m = 8;
constexpr double kTop_m = kLast_m + 2;
constexpr double kUp_m_s = 0.8, kDown_m_s = 2, kAtTop_s = 3;

// Up, for a while at the top, and down again: the way by which heights are taken that went by while
// nothing ran. Both ways begin when the test says so.
class Pilot {
 public:
  explicit Pilot(const Clock& clock) : clock_(clock), begun_(clock.now()) {}

  void take_off() { take_off_s_ = in_seconds(clock_.now() - begun_); }
  // After some seconds at the top.
  void descend() {
    const double at_top_s = take_off_s_ + kTop_m / kUp_m_s + kAtTop_s;
    descend_s_ = std::max(at_top_s, in_seconds(clock_.now() - begun_));
  }

  // At a time since it was made.
  double height_m(double seconds) const {
    const double up_m = std::clamp(kUp_m_s * (seconds - take_off_s_), 0.0, kTop_m);
    return std::max(up_m - kDown_m_s * std::max(seconds - descend_s_, 0.0), 0.0);
  }
  HostTime begun() const { return begun_; }

 private:
  const Clock& clock_;
  HostTime begun_;
  std::atomic<double> take_off_s_ = 1e9, descend_s_ = 1e9;
};

class KilledDaemon : public testing::Test {
 protected:
  KilledDaemon() {
    std::string pattern = (fs::temp_directory_path() / "plumbline-killed-XXXXXX").string();
    folder_ = ::mkdtemp(pattern.data());
    fs::create_directories(folder_ / "bench/flights");
    const std::string in = folder_ / "bench";
    write_text(folder_ / "bench/plumbline.toml",
               "[receiver]\naddress = \"" + receiver() +
                   "\"\n[camera]\nid = \"simulated\"\n"
                   "[release]\nby = \"pulse\"\nline = \"simulated\"\nlongest_delay_s = 10\n"
                   "[capture]\nfirst_m = " +
                   digits(kFirst_m) + "\nlast_m = " + digits(kLast_m) +
                   "\nstep_m = " + digits(kStep_m) +
                   "\naside_m = 0\n[measure]\nenabled = false\n[recording]\nfolder = \"" + in +
                   "/flights\"\n[status]\nfile = \"" + in + "/status.json\"\nsocket = \"" + in +
                   "/socket\"\n");
  }
  ~KilledDaemon() override { fs::remove_all(folder_); }

  std::string receiver() const { return folder_ / "receiver"; }

  void plug_in_the_receiver() {
    sim::GnssStreamOptions options;
    options.host_at_start = pilot_.begun();
    options.utc_at_start = std::chrono::floor<std::chrono::seconds>(clock_.wall().wall);
    const auto frame = *geodesy::LocalFrame::at({35.66, 139.76, 52.3});
    auto stream = std::make_shared<sim::GnssStream>(
        [this, frame](double seconds) {
          return frame.geodetic_of({0, 0, pilot_.height_m(seconds)});
        },
        options, 1);
    port_.emplace(clock_, receiver(),
                  [stream] { return std::optional<sim::LinePiece>(stream->next()); });
    ASSERT_TRUE(port_->start());
  }

  // Until the status says so; false after two minutes.
  static bool comes_to(const BenchedDaemon& daemon,
                       const std::function<bool(const Json&)>& wanted) {
    for (int k = 0; k < 1200; ++k) {
      const Json status = daemon.status();
      if (status.is_object() && wanted(status)) return true;
      std::this_thread::sleep_for(100ms);
    }
    return false;
  }
  static std::function<bool(const Json&)> phase_is(const std::string& phase) {
    return [phase](const Json& status) { return status.value("phase", "") == phase; };
  }

  // "0001/0003" for every photo that was said to be stored.
  static std::multiset<std::string> stored(const std::string& log) {
    std::multiset<std::string> photos;
    const std::regex said("Photo (\\d+) is stored in (\\d+)\\.");
    for (std::sregex_iterator at(log.begin(), log.end(), said), end; at != end; ++at) {
      const std::string number = (*at)[1];
      photos.insert((*at)[2].str() + "/photos/" + std::string(4 - number.size(), '0') + number +
                    ".jpg");
    }
    return photos;
  }

  fs::path folder_;
  posix::SystemClock clock_;
  Pilot pilot_{clock_};
  std::optional<sim::LivePort> port_;
};

// A JPEG file ends with its end-of-image marker.
bool is_whole(const std::string& jpeg) { return jpeg.ends_with("\xFF\xD9"); }

TEST_F(KilledDaemon, GoesOnWithItsFlightAndLosesNothingThatItSaidToBeStored) {
  sim::Random random(1, 75);
  plug_in_the_receiver();
  auto daemon = std::make_unique<BenchedDaemon>(folder_);
  ASSERT_TRUE(comes_to(*daemon, phase_is("ready"))) << daemon->log();
  pilot_.take_off();
  ASSERT_TRUE(comes_to(*daemon, phase_is("flying"))) << daemon->log();
  for (int kill = 0; kill < kKills; ++kill) {
    std::this_thread::sleep_for(
        std::chrono::duration<double>(random.uniform(kShortestLife_s, kLongestLife_s)));
    daemon->kill();
    daemon = std::make_unique<BenchedDaemon>(folder_);
    const auto flies_on = [&](const Json& status) {
      return status.value("pid", 0) == daemon->process() && phase_is("flying")(status);
    };
    ASSERT_TRUE(comes_to(*daemon, flies_on)) << daemon->log();
  }
  pilot_.descend();
  ASSERT_TRUE(comes_to(*daemon, [](const Json& status) {
    return !status.value("last_flight", "").empty();
  })) << daemon->log();
  EXPECT_EQ(daemon->stop(), 0);

  const auto photos = stored(daemon->log());
  EXPECT_GE(photos.size(), 1u);
  for (const std::string& photo : photos) {
    EXPECT_EQ(photos.count(photo), 1u) << photo;
    EXPECT_TRUE(is_whole(text_of(folder_ / "bench/flights" / photo))) << photo;
    EXPECT_TRUE(photo.starts_with("0001/")) << "one flight: " << photo;
  }
  const Outcome check = run_plumbline({"check", daemon->flight().string(), "--dump"}, folder_);
  EXPECT_EQ(check.status, 0) << check.out << check.err;
  for (double step = kFirst_m; step <= kLast_m; step += kStep_m) {
    const std::string taken = "for=height step_m=" + digits(step);
    EXPECT_NE(check.out.find(taken), std::string::npos) << taken << check.out << daemon->log();
  }
}

}  // namespace
}  // namespace plumbline::acceptance
