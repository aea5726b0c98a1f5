// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "drivers/camera.h"

namespace plumbline::contract {

// What came from a camera, for a test that looks at it from another thread.
class CameraEvents {
 public:
  // Frames are held until release(), up to `most`; of the others only the figures are kept.
  void hold(std::size_t most);
  std::vector<Frame> release();

  void add(CameraEvent event);

  std::vector<Frame> frames() const;  // without images, unless held
  std::uint64_t lost() const;
  std::vector<CameraReport> reports() const;
  std::vector<CameraNotice> notices() const;
  std::size_t count() const;  // of all events
  bool damaged() const;       // a frame whose image was not whole
  // Where sequence and frames lost did not add up, or time ran backwards; empty where nowhere.
  std::string disorder() const;

 private:
  void check(const Frame& frame);

  mutable std::mutex mutex_;
  std::vector<Frame> frames_;
  std::vector<std::shared_ptr<const RawImage>> held_;
  std::size_t most_held_ = 0;
  std::vector<CameraReport> reports_;
  std::vector<CameraNotice> notices_;
  std::uint64_t lost_ = 0;
  std::uint64_t lost_since_frame_ = 0;
  std::size_t count_ = 0;
  bool damaged_ = false;
  std::string disorder_;
};

// What a bench can do to its camera, beside letting it run.
enum class CameraFault {
  kSilence,      // no frame comes any more, until the next `mend`
  kDrop,         // some frames are lost
  kBrokenStream  // reading fails once with EIO
};

// One implementation of Camera, and a hand on it. Time passes only in pass().
class CameraBench {
 public:
  virtual ~CameraBench() = default;

  virtual std::unique_ptr<Camera> camera() = 0;  // the same device each time
  virtual std::unique_ptr<Camera> missing_camera() = 0;
  virtual CameraOptions options() = 0;
  // The rate by which the driver counts what an outage lost; empty: that at which frames come.
  virtual std::optional<std::chrono::nanoseconds> period() { return std::nullopt; }
  virtual int pulls() { return 50; }  // how often it is unplugged in a row
  virtual HostTime now() = 0;
  virtual void pass(std::chrono::nanoseconds time) = 0;

  // False where this camera cannot be made to: the test is skipped.
  virtual bool inflict(CameraFault fault) = 0;
  virtual void mend() = 0;
  virtual bool unplug() = 0;
  virtual void plug_in() = 0;
};

// Prints as its name in test output.
struct NamedCameraBench {
  std::string name;  // letters only
  // nullptr where there is no such device; then `why_not` says what is missing.
  std::function<std::unique_ptr<CameraBench>()> make;
  std::string why_not;

  friend std::ostream& operator<<(std::ostream& out, const NamedCameraBench& bench) {
    return out << bench.name;
  }
};

// The contract of drivers/camera.h as tests, for any bench.
class CameraContract : public testing::TestWithParam<NamedCameraBench> {
 protected:
  void SetUp() override;
  void TearDown() override;

  void start();
  // Goes on until it holds; false when it did not within `at_most`.
  bool until(const std::function<bool()>& holds, std::chrono::milliseconds at_most);
  bool frames_come(std::size_t count, std::chrono::milliseconds at_most);
  // The first report of that state after the first `after`, within the promised time of now.
  bool reports(CameraState state, std::size_t after, std::chrono::milliseconds at_most);
  std::chrono::milliseconds detection_limit() const;

  std::unique_ptr<CameraBench> bench_;
  std::unique_ptr<Camera> camera_;
  CameraEvents events_;
};

}  // namespace plumbline::contract
