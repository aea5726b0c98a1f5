// SPDX-License-Identifier: MIT
// The daemon with the devices of this machine: a port that is not there, and an autopilot by UDP.
#include "firmware/service/daemon.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <mutex>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "drivers/patient_line.h"
#include "edge/mavlink/frame_reader.h"
#include "edge/mavlink/messages.h"
#include "edge/record/journal.h"
#include "firmware/devices_on_board.h"
#include "firmware/ingest/camera_toml.h"
#include "tests/firmware/ingest/temporary_folder.h"
#include "tests/talk/pilot_talk.h"
#include "tests/talk/udp_peer.h"

namespace plumbline::service {
namespace {

using namespace std::chrono_literals;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::Not;

constexpr int kOwnSystem = 7;

// What a pilot sees of the texts that come.
class Screen {
 public:
  // Until one holds `part`, for so many tenths of a second at most.
  std::vector<std::string> texts_until(const std::string& part, int tenths = 100) {
    texts_.clear();
    const auto holds = [&](const std::string& text) {
      return text.find(part) != std::string::npos;
    };
    for (int k = 0; k < tenths && std::none_of(texts_.begin(), texts_.end(), holds); ++k) {
      reader_.feed(vehicle_.receive(100ms));
    }
    return texts_;
  }

  void say_heartbeat(bool armed) {
    talk::PilotSender sender;
    vehicle_.send_to(vehicle_.sender_port(), talk::vehicle_heartbeat(armed, sender));
  }

  int port() const { return vehicle_.port(); }
  int sender_system() const { return sender_system_; }

 private:
  void take(const mavlink::Frame& frame) {
    sender_system_ = frame.system_id;
    if (frame.id != mavlink::kStatusText) return;
    if (const auto status = mavlink::status_text_of(frame)) texts_.push_back(status->text);
  }

  talk::UdpPeer vehicle_;
  mavlink::FrameReader reader_{[this](const mavlink::Frame& frame) { take(frame); }};
  std::vector<std::string> texts_;
  int sender_system_ = 0;
};

// A disk of which somebody else takes the room, and a clock that is ahead.
class FillingDisk : public Storage {
 public:
  explicit FillingDisk(std::unique_ptr<Storage> real) : real_(std::move(real)) {}
  void set_free(std::uint64_t bytes) { free_ = bytes; }
  int looks() const { return looks_; }

  Result<std::unique_ptr<WritableFile>> create(const std::string& path) override {
    return real_->create(path);
  }
  Result<std::unique_ptr<WritableFile>> append_to(const std::string& path) override {
    return real_->append_to(path);
  }
  Result<std::string> read(const std::string& path) override { return real_->read(path); }
  Status truncate(const std::string& path, std::uint64_t length) override {
    return real_->truncate(path, length);
  }
  Status rename(const std::string& from, const std::string& to) override {
    return real_->rename(from, to);
  }
  Status remove(const std::string& path) override { return real_->remove(path); }
  Status make_folder(const std::string& path) override { return real_->make_folder(path); }
  Status sync_folder(const std::string& path) override { return real_->sync_folder(path); }
  Result<std::vector<std::string>> list(const std::string& folder) override {
    return real_->list(folder);
  }
  Result<std::uint64_t> free_bytes() override {
    ++looks_;
    return free_.load();
  }

 private:
  std::unique_ptr<Storage> real_;
  std::atomic<std::uint64_t> free_ = 1'000'000'000'000;
  std::atomic<int> looks_ = 0;
};

class ClockAhead : public Clock {
 public:
  explicit ClockAhead(std::unique_ptr<Clock> real) : real_(std::move(real)) {}
  void skip(std::chrono::nanoseconds time) { ahead_ = ahead_.load() + time; }
  HostTime now() const override { return real_->now() + ahead_.load(); }
  WallReading wall() const override {
    WallReading reading = real_->wall();
    reading.host += ahead_.load();
    return reading;
  }
  bool wait(Signal& signal, HostTime deadline) override {
    return real_->wait(signal, deadline == HostTime::max() ? deadline : deadline - ahead_.load());
  }

 private:
  std::unique_ptr<Clock> real_;
  std::atomic<std::chrono::nanoseconds> ahead_ = 0ns;
};

class DaemonOnBoard : public testing::Test {
 protected:
  DaemonOnBoard() {
    std::filesystem::create_directories(folder_ / "flights");
    config_.recording.folder = folder_ / "flights";
    config_.status.file = folder_ / "status.json";
    config_.status.socket = folder_ / "socket";
    config_.measure.enabled = false;
    config_.capture.plan.heights_m = {30, 40};
  }

  void start() {
    clock_ = std::make_unique<ClockAhead>(make_clock());
    storage_ = std::make_unique<FillingDisk>(open_folder(config_.recording.folder).value());
    receiver_ = make_receiver(folder_ / "no-receiver", *clock_).value();
    pilot_ =
        make_pilot_link("udp://127.0.0.1:" + std::to_string(screen_.port()), kOwnSystem, *clock_)
            .value();
    flight::Devices devices{*clock_, *storage_, *receiver_};
    devices.pilot = pilot_.get();
    devices.pulse_per_second = pulses_.get();
    DaemonEvents events;
    events.told = [this](const std::string& sentence) {
      const std::lock_guard lock(mutex_);
      told_ += sentence + '\n';
    };
    auto daemon = Daemon::start(config_, "", devices, events);
    ASSERT_TRUE(daemon) << daemon.error().sentence;
    daemon_ = std::move(*daemon);
    thread_ = std::thread([this] { daemon_->run(); });
  }

  void end() {
    if (!daemon_) return;
    daemon_->stop();
    thread_.join();
    daemon_.reset();
  }
  ~DaemonOnBoard() override { end(); }

  // Waits until the log of what was told holds `part`, ten seconds at most.
  bool is_told(const std::string& part) {
    for (int k = 0; k < 100; ++k) {
      {
        const std::lock_guard lock(mutex_);
        if (told_.find(part) != std::string::npos) return true;
      }
      std::this_thread::sleep_for(100ms);
    }
    return false;
  }
  void hear_frame_of(int rows) {
    RawImage image;
    image.height_px = rows;
    Frame frame;
    frame.timing.first_row_start = clock_->now();
    frame.image = std::make_shared<const RawImage>(image);
    daemon_->hear(flight::DeviceEvent{CameraEvent{std::move(frame)}});
  }
  // Something that the deciding thread hears.
  void stir() { daemon_->hear(flight::PulseLine{LineEdge{clock_->now(), true, 0}}); }

  ingest::TemporaryFolder folder_;
  config::Config config_;
  Screen screen_;
  std::mutex mutex_;
  std::string told_;
  std::unique_ptr<ClockAhead> clock_;
  std::unique_ptr<FillingDisk> storage_;
  std::unique_ptr<GnssReceiver> receiver_;
  std::unique_ptr<PilotLink> pilot_;
  std::unique_ptr<TriggerLine> pulses_;
  std::unique_ptr<Daemon> daemon_;
  std::thread thread_;
};

TEST_F(DaemonOnBoard, TellsThePilotOfAFullDiskAtOnceAndAgainWhenTheVehicleIsArmed) {
  config_.recording.keep_free_mb = 1e9;
  start();
  const std::string full = "Disk: room for 0 of 3 photos";
  EXPECT_THAT(screen_.texts_until(full), Contains(full));
  EXPECT_EQ(screen_.sender_system(), kOwnSystem) << "no vehicle was heard yet";
  screen_.say_heartbeat(false);
  EXPECT_THAT(screen_.texts_until(full), Contains(full));
  screen_.say_heartbeat(true);
  EXPECT_THAT(screen_.texts_until(full), Contains(full));
  EXPECT_THAT(daemon_->board().json(), HasSubstr("\"free_photos\":0"));
}

TEST_F(DaemonOnBoard, SaysNothingOfADiskWithRoom) {
  config_.recording.keep_free_mb = 0;
  start();
  EXPECT_THAT(screen_.texts_until("Disk", 15), Not(Contains(HasSubstr("Disk"))));
  screen_.say_heartbeat(true);
  EXPECT_THAT(screen_.texts_until("Disk", 15), Not(Contains(HasSubstr("Disk"))));
}

TEST_F(DaemonOnBoard, LooksAtTheDiskAgainWhileItWaits) {
  start();
  EXPECT_THAT(screen_.texts_until("Disk", 5), Not(Contains(HasSubstr("Disk"))));
  storage_->set_free(1);
  clock_->skip(11s);
  stir();
  EXPECT_TRUE(is_told("room for 0 of 3 photos."));
  const std::string full = "Disk: room for 0 of 3 photos";
  EXPECT_THAT(screen_.texts_until(full), Contains(full));
  EXPECT_THAT(daemon_->board().sentence(), HasSubstr("the disk has room for 0 photos of 3"));
  clock_->skip(11s);
  stir();
  EXPECT_THAT(screen_.texts_until("Disk", 15), Not(Contains(HasSubstr("Disk")))) << "once";
  storage_->set_free(1'000'000'000'000);
  clock_->skip(11s);
  stir();
  EXPECT_TRUE(is_told("of 3 photos again."));
}

TEST_F(DaemonOnBoard, LooksAtTheDiskOnceInTenSeconds) {
  start();
  stir();
  EXPECT_TRUE(is_told("receiver: "));
  const int looks = storage_->looks();
  for (int k = 0; k < 50; ++k) {
    stir();
    std::this_thread::sleep_for(10ms);
  }
  EXPECT_LE(storage_->looks(), looks + 1);
}

// The camera gives what it likes where the configuration asks for no size.
TEST_F(DaemonOnBoard, SaysThatTheCalibrationIsForPicturesOfAnotherSize) {
  geometry::Camera camera;
  camera.width_px = 4000;
  camera.height_px = 2250;
  camera.interior << 2125, 1999.5, 1124.5, 0, 0, 0, 0, 0, 0, 0;
  folder_.write("camera.toml", ingest::camera_toml(camera));
  config_.camera.calibration = folder_ / "camera.toml";
  start();
  hear_frame_of(2250);
  hear_frame_of(3000);
  EXPECT_TRUE(is_told("calibration: camera.calibration " + config_.camera.calibration));
  EXPECT_THAT(daemon_->board().sentence(),
              AllOf(HasSubstr("4000 x 2250 pixels"), HasSubstr("3000 pixels high")));
  const std::string to_pilot = "Calibration is for another picture size";
  EXPECT_THAT(screen_.texts_until(to_pilot), Contains(to_pilot));
  hear_frame_of(2250);
  EXPECT_TRUE(is_told("calibration: It is for pictures of this size."));
  EXPECT_THAT(daemon_->board().sentence(), Not(HasSubstr("calibration")));
}

// Of what happened on the ground the recording tells, too.
TEST_F(DaemonOnBoard, RecordsWhatIsNoted) {
  start();
  daemon_->note(record::Severity::kInfo, "pulse per second", "It is there.");
  EXPECT_TRUE(is_told("pulse per second: It is there."));
  end();
  std::ifstream file(folder_ / "flights/0001/flight.journal", std::ios::binary);
  const std::string journal{std::istreambuf_iterator<char>(file), {}};
  EXPECT_THAT(journal, HasSubstr("It is there."));
}

TEST_F(DaemonOnBoard, StartsWithoutThePulsePerSecondAndSaysSo) {
  const std::unique_ptr<Clock> clock = make_clock();
  const std::string missing = folder_ / "pps0";
  pulses_ =
      std::make_unique<PatientLine>([&] { return make_pulse_per_second(missing, *clock); }, *clock);
  start();
  EXPECT_TRUE(is_told("pulse per second: Cannot open '" + missing + "': it is not there"));
  EXPECT_THAT(daemon_->board().sentence(), HasSubstr(missing));
  end();
  pulses_.reset();
}

TEST_F(DaemonOnBoard, MakesTheFoldersOfFlightsWhereTheyAreMissing) {
  const std::string wanted = folder_ / "var/lib/flights";
  EXPECT_FALSE(open_folder(wanted));
  const auto made = open_or_make_folder(wanted);
  ASSERT_TRUE(made) << made.error().sentence;
  EXPECT_TRUE(std::filesystem::is_directory(wanted));
  EXPECT_TRUE((*made)->make_folder("0001"));
  EXPECT_TRUE(open_or_make_folder(wanted));
  folder_.write("file", std::string("x"));
  const auto none = open_or_make_folder(folder_ / "file/flights");
  ASSERT_FALSE(none);
  EXPECT_THAT(none.error().sentence, HasSubstr("file"));
}

TEST_F(DaemonOnBoard, MeasuresTheFlightBeforeThatHasNoResult) {
  for (const char* photo : {"1.jpg", "2.jpg", "3.jpg"}) {
    folder_.write(std::string("flights/0001/photos/") + photo, std::string("x"));
  }
  std::string journal = record::journal_head();
  record::append_entry(record::Began{"plumblined", "", "boot", {}, {}}, 0, journal);
  record::append_entry(record::Ended{{}, "landed"}, 1, journal);
  folder_.write("flights/0001/flight.journal", journal);
  config_.measure.enabled = true;
  config_.measure.command = "request";
  start();
  EXPECT_TRUE(is_told("Flight 0001: It has no result yet, and is measured now."));
  const std::string result =
      R"({"photos_used": 3, "unobservable": [],
          "point_sigmas": {"median_e_m": 0.05, "median_n_m": 0.04, "median_u_m": 0.03}})";
  for (int k = 0; k < 100 && !std::filesystem::exists(folder_ / "flights/measure.request"); ++k) {
    std::this_thread::sleep_for(50ms);
  }
  folder_.write("new", result);
  std::filesystem::create_directory(folder_ / "flights/0001/result");
  std::filesystem::rename(folder_ / "new", folder_ / "flights/0001/result/summary.json");
  EXPECT_TRUE(is_told("Flight 0001: Measured from 3 photos: "));
  EXPECT_THAT(daemon_->board().sentence(), HasSubstr("Median sigma 5.0/4.0/3.0 cm"));
  end();
  told_.clear();
  start();
  EXPECT_TRUE(is_told("receiver: "));
  end();
  EXPECT_THAT(told_, Not(HasSubstr("Flight 0001"))) << "it has its result";
}

nlohmann::json status_in(const std::filesystem::path& file) {
  return nlohmann::json::parse(std::ifstream(file), nullptr, false);
}

TEST_F(DaemonOnBoard, LeavesAStatusThatClaimsNothingMore) {
  start();
  EXPECT_EQ(status_in(config_.status.file)["phase"], "waiting");
  end();
  EXPECT_EQ(status_in(config_.status.file)["phase"], "stopped");
  EXPECT_FALSE(std::filesystem::exists(config_.status.socket));
}

}  // namespace
}  // namespace plumbline::service
