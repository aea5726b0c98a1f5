// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <string>

namespace plumbline::hil {

struct UvcMode {
  int width_px = 640;
  int height_px = 360;
  int frames_per_s = 10;

  std::uint32_t frame_bytes() const {
    return 2U * static_cast<std::uint32_t>(width_px) * static_cast<std::uint32_t>(height_px);
  }
  std::uint32_t interval_100ns() const {
    return 10'000'000U / static_cast<std::uint32_t>(frames_per_s);
  }
  std::chrono::nanoseconds interval() const {
    return std::chrono::nanoseconds(100) * interval_100ns();
  }

  // The first middle of an exposure after `time`: one every interval, since the clock began.
  std::chrono::steady_clock::time_point moment_after(
      std::chrono::steady_clock::time_point time) const {
    return std::chrono::steady_clock::time_point((time.time_since_epoch() / interval() + 1) *
                                                 interval());
  }
};

constexpr unsigned kUvcVendor = 0x1209;   // pid.codes, for what has no vendor
constexpr unsigned kUvcProduct = 0x0001;  // its number for tests
constexpr unsigned kUvcEndpoint = 0x81;
constexpr unsigned kUvcPacketBytes = 512;     // of the bulk endpoint, at high speed
constexpr unsigned kUvcPayloadBytes = 16384;  // of one transfer, header included
constexpr unsigned kUvcCameraTerminal = 1;    // entities, as controls address them
constexpr unsigned kUvcProcessingUnit = 2;

// What a camera of USB Video Class 1.0 with one mode (YUY2, bulk) says of itself. Chapter and
// names: "USB Device Class Definition for Video Devices", 3.
std::string uvc_device_descriptor();
std::string uvc_configuration(const UvcMode& mode);
std::string uvc_string(unsigned index);  // empty where there is none

}  // namespace plumbline::hil
