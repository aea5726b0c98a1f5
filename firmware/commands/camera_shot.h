// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "drivers/camera.h"
#include "drivers/signal.h"
#include "edge/base/result.h"

namespace plumbline::commands {

struct ShotOptions {
  CameraOptions camera;                       // with `raw` the file is a DNG, else a JPEG
  std::chrono::milliseconds settle{1000};     // frames of so long are let by: gain finds the light
  std::chrono::milliseconds patience{10000};  // without a photo after that it has failed
  int quality = 95;                           // of a JPEG
};

struct Shot {
  std::vector<std::uint8_t> file;
  int width_px = 0;
  int height_px = 0;
  Frame frame;                       // without its image
  std::vector<std::string> notices;  // what the camera could not do as asked for
};

// Lets so much time pass, or less: until the signal is raised.
using WaitForSignal = std::function<void(Signal& signal, std::chrono::nanoseconds longest)>;

// Starts the camera, takes one photo, stops it. On failure the sentence is the camera's last one.
Result<Shot> take_shot(Camera& camera, const ShotOptions& options, const WaitForSignal& wait);

}  // namespace plumbline::commands
