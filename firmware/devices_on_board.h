// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/byte_stream.h"
#include "drivers/camera.h"
#include "drivers/clock.h"
#include "drivers/gnss_receiver.h"
#include "drivers/pilot_link.h"
#include "drivers/storage.h"
#include "drivers/trigger_line.h"
#include "edge/base/result.h"

namespace plumbline {

// The real devices, each behind its seam. No other file of firmware/ knows what they are.

std::unique_ptr<Clock> make_clock();

// "/dev/ttyACM0", "/dev/ttyUSB0@38400" (without a speed it is found), "tcp://HOST:PORT", or the
// path of a log, which is played as fast as it is read. Fails where the address is none; whether
// the receiver is there is start()'s business. `clock` outlives the receiver.
Result<std::unique_ptr<GnssReceiver>> make_receiver(const std::string& address, const Clock& clock);

// "/dev/ttyAMA1@921600" (57600 baud where no speed is said), "udp://0.0.0.0:14550" (waits to be
// spoken to at that port), or "udp://HOST:PORT" (speaks first); by UDP it answers to whoever spoke
// last. `system_id`: the vehicle's, 1 to 255, borne until it has been heard. Fails where the
// address is none; whether an autopilot is there is start()'s business. `clock` outlives the link.
Result<std::unique_ptr<PilotLink>> make_pilot_link(const std::string& address, int system_id,
                                                   const Clock& clock);

std::vector<SerialPortInfo> list_serial_ports();

// A folder of the file system; fails where it is not there, or makes it and those above it, so that
// their names survive a power cut. And what is to be said of the kind of file system it lies on,
// empty where nothing is.
Result<std::unique_ptr<Storage>> open_folder(const std::string& folder);
Result<std::unique_ptr<Storage>> open_or_make_folder(const std::string& folder);
std::optional<std::string> folder_warning(const std::string& folder);

// Wires to and from a camera's shutter, on GPIO lines; an empty name: without that one.
struct ShutterWires {
  std::string pulse_line;
  bool pulse_active_low = false;
  std::chrono::microseconds pulse_width = std::chrono::milliseconds(20);
  std::string feedback_line;
  bool feedback_active_low = false;
};
Result<std::unique_ptr<TriggerLine>> make_shutter_wires(const ShutterWires& wires,
                                                        const Clock& clock);

// "gpio:LINE" or "/dev/pps0": a receiver's pulse per second, as edges of an input line.
Result<std::unique_ptr<TriggerLine>> make_pulse_per_second(const std::string& address,
                                                           const Clock& clock);

// A camera by its id: a video device ("/dev/video0" or a link to one) or "libcamera:" and the id
// that libcamera gives it. Fails where libcamera is asked for and cannot be had; whether the camera
// is there is start()'s business. `clock` outlives the camera.
Result<std::unique_ptr<Camera>> make_camera(const std::string& id, const Clock& clock);

struct CamerasOnBoard {
  std::vector<CameraDescription> cameras;  // ids as make_camera() takes them, best first
  std::vector<std::string> remarks;        // what may be missing from the list, and why
};

// libcamera's cameras first: behind V4L2 the same ones may be mere sensors without processing.
CamerasOnBoard list_cameras();

}  // namespace plumbline
