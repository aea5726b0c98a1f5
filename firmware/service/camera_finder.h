// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <functional>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "drivers/camera.h"
#include "drivers/clock.h"

namespace plumbline::service {

// What there is, best first, and what may be missing from the list.
struct CamerasListed {
  std::vector<std::string> ids;
  std::vector<std::string> remarks;
};

// Looks for any camera until one can be started, and hands on what it reports. Why there is none is
// reported once for each reason, as a camera would report it; a remark that was not there at the
// look before waits for the next. A thread of its own.
class CameraFinder {
 public:
  struct Cameras {
    std::function<CamerasListed()> list;
    std::function<Result<std::unique_ptr<Camera>>(const std::string& id)> make;
    std::chrono::milliseconds every{500};
  };

  // `clock` outlives it. `sink` is called from its thread until there is a camera, then from that.
  CameraFinder(const CameraOptions& options, const Clock& clock, Cameras cameras,
               Camera::Sink sink);
  ~CameraFinder();

 private:
  void run(const std::stop_token& stop);
  bool find();
  Status start(const std::string& id);
  void tell(CameraState state, const std::string& sentence);

  CameraOptions options_;
  const Clock& clock_;
  Cameras cameras_;
  Camera::Sink sink_;
  std::string told_;
  std::optional<std::set<std::string>> remarks_;  // of the look before
  std::unique_ptr<Camera> camera_;
  std::jthread thread_;
};

}  // namespace plumbline::service
