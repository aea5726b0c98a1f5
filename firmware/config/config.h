// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "drivers/camera.h"
#include "edge/capture/capture_plan.h"

// What plumblined is told by its configuration file. A Config that nothing was put into holds the
// defaults; plumbline_example.toml names every key with its unit and default, config_toml.h reads
// such a file and promises the ranges.

namespace plumbline::config {

struct ReceiverConfig {
  std::string address = "/dev/ttyACM0";  // as make_receiver() of devices_on_board.h takes it
  std::string pps;    // pulse per second: "" none, "gpio:LINE" with LINE as below, or "/dev/pps0"
  std::string datum;  // of the base's coordinates, for the results; "": not known
};

struct CameraConfig {
  static constexpr const char* kNone = "none";

  // As make_camera() takes it; "": the first of list_cameras(); kNone: it keeps its photos.
  std::string id;
  CameraOptions options;
  int jpeg_quality = 95;
  std::string calibration;  // path of a camera.toml that each flight gets a copy of; "": none
};

// `list_m` where it is not empty, else from first to last.
struct Heights {
  std::vector<double> list_m;  // ascending
  double first_m = 30;
  double last_m = 90;  // not below the first
  double step_m = 5;
};

// The wire to the shutter and back. A line is "/dev/gpiochip0:17", "gpiochip0:17" or its name.
struct TriggerConfig {
  std::string line;  // "": none
  bool active_low = false;
  std::chrono::microseconds pulse = std::chrono::milliseconds(20);
  std::string feedback_line;  // "": none
  bool feedback_active_low = false;
};

struct PilotConfig {
  std::string link;   // MAVLink: "" none, "udp://HOST:PORT", or a port "/dev/ttyAMA1@57600"
  int system_id = 1;  // of the vehicle
  // Azimuth of the top of the photos from the vehicle's nose, clockwise: where it is known, the
  // autopilot's heading is the photos', with that sigma.
  std::optional<double> photo_top_deg;
  double heading_sigma_deg = 5;  // of a compass among motors
};

struct RecordingConfig {
  std::string folder = "/var/lib/plumbline/flights";
  int keep_free_mb = 500;      // photos are not to need it; 1 MB is 1,000,000 bytes
  bool clean_results = false;  // the oldest results, never photos, may go to make room
};

struct AdviceConfig {
  bool enabled = true;
  double goal_m = 0.05;  // sigma to reach
};

struct MeasureConfig {
  bool enabled = true;
  int memory_mb = 1500;
  std::chrono::seconds longest{900};
  std::string command;  // "": `plumbline measure` as a child; "request": a file asks a path unit
};

struct StatusConfig {
  std::string file = "/run/plumbline/status.json";
  std::string socket = "/run/plumbline/plumblined.sock";
};

struct Config {
  ReceiverConfig receiver;
  CameraConfig camera;
  Heights heights;
  capture::CaptureOptions capture;  // plan.heights_m is what `heights` says
  TriggerConfig trigger;
  PilotConfig pilot;
  RecordingConfig recording;
  AdviceConfig advice;
  MeasureConfig measure;
  StatusConfig status;
};

}  // namespace plumbline::config
