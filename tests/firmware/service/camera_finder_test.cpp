// SPDX-License-Identifier: MIT
#include "firmware/service/camera_finder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "sim/virtual_clock.h"

namespace plumbline::service {
namespace {

using namespace std::chrono_literals;
using ::testing::HasSubstr;

// A camera that starts, or says why not.
class FakeCamera : public Camera {
 public:
  explicit FakeCamera(std::string why_not) : why_not_(std::move(why_not)) {}
  Status start(const CameraOptions&, Sink sink) override {
    if (!why_not_.empty()) return Error{why_not_};
    sink(CameraReport{HostTime{}, CameraState::kStreaming, "It streams."});
    return Done{};
  }
  void stop() override {}
  void limit_exposure(std::chrono::microseconds) override {}
  Result<CameraDescription> describe() override { return CameraDescription{}; }

 private:
  std::string why_not_;
};

struct Listed {
  std::string id;
  std::string why_not_made;
  std::string why_not_started;
};

class FoundCamera : public testing::Test {
 protected:
  void set(std::vector<Listed> listed) {
    const std::lock_guard lock(mutex_);
    listed_ = std::move(listed);
  }
  CameraFinder::Cameras cameras() {
    CameraFinder::Cameras cameras;
    cameras.list = [this] {
      const std::lock_guard lock(mutex_);
      CamerasListed found;
      for (const Listed& one : listed_) found.ids.push_back(one.id);
      if (listed_.empty()) found.remarks = remarks_;
      if (!passing_remark_.empty()) found.remarks.push_back(std::exchange(passing_remark_, ""));
      return found;
    };
    cameras.make = [this](const std::string& id) -> Result<std::unique_ptr<Camera>> {
      const std::lock_guard lock(mutex_);
      for (const Listed& one : listed_) {
        if (one.id != id) continue;
        if (!one.why_not_made.empty()) return Error{one.why_not_made};
        return {std::make_unique<FakeCamera>(one.why_not_started)};
      }
      return Error{"gone"};
    };
    cameras.every = 10ms;
    return cameras;
  }
  void keep(const CameraEvent& event) {
    const std::lock_guard lock(mutex_);
    if (const auto* report = std::get_if<CameraReport>(&event)) said_.push_back(report->sentence);
    if (const auto* notice = std::get_if<CameraNotice>(&event)) said_.push_back(notice->sentence);
  }
  // What was said, once it is so much; five seconds at most.
  std::vector<std::string> said(std::size_t count) {
    for (int k = 0; k < 500; ++k) {
      {
        const std::lock_guard lock(mutex_);
        if (said_.size() >= count) return said_;
      }
      std::this_thread::sleep_for(10ms);
    }
    const std::lock_guard lock(mutex_);
    return said_;
  }

  sim::VirtualClock clock_{HostTime(100s)};
  std::mutex mutex_;
  std::vector<Listed> listed_;
  std::vector<std::string> remarks_ = {"No module."};
  std::string passing_remark_;  // of one look
  std::vector<std::string> said_;
};

TEST_F(FoundCamera, IsMissedInWordsUntilItIsThere) {
  const CameraFinder finder({}, clock_, cameras(), [this](const CameraEvent& e) { keep(e); });
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_THAT(said(1)[0], HasSubstr("No camera is found"));
  EXPECT_THAT(said(1)[0], HasSubstr("No module."));
  set({{"/dev/video0", "", ""}});
  EXPECT_EQ(said(2).back(), "It streams.");
}

// udev gives the right to it a moment after it has come.
TEST_F(FoundCamera, IsNotComplainedAboutForWhatIsOverAtTheNextLook) {
  const CameraFinder finder({}, clock_, cameras(), [this](const CameraEvent& e) { keep(e); });
  ASSERT_EQ(said(1).size(), 1u);
  {
    const std::lock_guard lock(mutex_);
    passing_remark_ = "No right to open it.";
  }
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(said(0).size(), 1u);
  {
    const std::lock_guard lock(mutex_);
    remarks_.emplace_back("No right to open that one.");
  }
  EXPECT_THAT(said(2).back(), HasSubstr("No right to open that one."));
}

TEST_F(FoundCamera, IsSaidNotToStartAndWhyOnceForEachReason) {
  set({{"/dev/video0", "", "It is held by another program."}});
  const CameraFinder finder({}, clock_, cameras(), [this](const CameraEvent& e) { keep(e); });
  ASSERT_EQ(said(1).size(), 1u);
  EXPECT_EQ(said(1)[0], "/dev/video0: It is held by another program.");
  std::this_thread::sleep_for(100ms);
  EXPECT_EQ(said(0).size(), 1u);
  set({{"/dev/video0", "No right to open it.", ""}});
  EXPECT_EQ(said(2).back(), "/dev/video0: No right to open it.");
  set({{"/dev/video0", "", ""}});
  EXPECT_EQ(said(3).back(), "It streams.");
}

TEST_F(FoundCamera, IsTheNextOneWhereTheBestFailsAndSaysWhy) {
  set({{"a", "", "Busy."}, {"b", "", ""}});
  const CameraFinder finder({}, clock_, cameras(), [this](const CameraEvent& e) { keep(e); });
  ASSERT_EQ(said(2).size(), 2u);
  EXPECT_EQ(said(2)[0], "It streams.");
  EXPECT_EQ(said(2)[1], "Took b, for: a: Busy.");
}

}  // namespace
}  // namespace plumbline::service
