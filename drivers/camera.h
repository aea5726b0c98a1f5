// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "edge/base/exposure_timing.h"
#include "edge/base/raw_image.h"
#include "edge/base/result.h"
#include "edge/base/time.h"

namespace plumbline {

// One frame, at the full resolution of the stream. Its buffer is lent: the driver has only a few,
// and drops frames (and counts them) while all are held. Copy or release within a frame or two.
struct Frame {
  std::uint64_t sequence = 0;  // counts on without a gap as long as none was lost
  int interior_number = 0;     // changes with mode or lens position: a new camera
  ExposureTiming timing;
  std::optional<double> gain;  // 1: none
  std::optional<double> lens_position_dioptre;
  RawColour colour;  // of a Bayer frame
  std::shared_ptr<const RawImage> image;
};

// Frames that the device or the driver dropped, before the next one.
struct FramesLost {
  HostTime time;
  std::uint64_t count = 0;
};

enum class CameraState { kAbsent, kStarting, kStreaming, kStalled, kFailing };

// Sent when the state changes. `sentence` is for a person: what, where, what to do.
struct CameraReport {
  HostTime time;
  CameraState state = CameraState::kAbsent;
  std::string sentence;
};

// What could not be had as asked for, or what changed inside the camera while it ran.
struct CameraNotice {
  HostTime time;
  std::string sentence;
};

using CameraEvent = std::variant<Frame, FramesLost, CameraReport, CameraNotice>;

struct CameraOptions {
  // The largest size that the camera offers, unless given.
  std::optional<int> width_px;
  std::optional<int> height_px;
  std::optional<PixelFormat> format;
  bool raw = false;  // Bayer only, in all bits that the camera has, for a raw file
  std::optional<double> frames_per_s;
  // Shutter priority: exposure no longer than this (the bound that blur sets), gain to suit; with a
  // fixed gain, too, both are constant. Where the camera cannot, a notice says so.
  std::chrono::microseconds longest_exposure{2000};
  std::optional<double> fixed_gain;
  bool fixed_exposure = false;  // exposure = longest_exposure whatever the light
  // Focus is locked: at this, or where it is.
  std::optional<double> lens_position_dioptre;
  // Of a rolling shutter, from one row to the next, where the driver cannot know it; 0: global.
  std::optional<std::chrono::nanoseconds> row_time;
};

struct CameraMode {
  int width_px = 0;
  int height_px = 0;
  PixelFormat format = PixelFormat::kGrey;
  std::optional<double> frames_per_s;
};

struct CameraControl {
  std::string name;
  double minimum = 0;
  double maximum = 0;
  double value = 0;
};

struct CameraDescription {
  std::string id;      // what the options name it by: "/dev/video0", libcamera's id
  std::string name;    // model
  std::string driver;  // "uvcvideo", "libcamera"
  std::vector<CameraMode> modes;
  std::vector<CameraControl> controls;
};

// SEAM: a camera that is kept streaming. There is no separate still: whoever wants a photo of an
// instant takes the frame whose exposure lies nearest to it (edge/capture/frame_ring.h), so nothing
// inside the camera moves between photos. start(), stop() and limit_exposure() are called from one
// thread; the sink from one thread at a time, the driver's own (in a simulation: that which waits
// on the clock), in order of exposure, never after stop() has returned; it must not block and must
// not call back into the camera.
//
// What is promised on failure: a camera that is missing, unplugged, silent or failing is a
// CameraReport within two frame intervals or 1 s, whichever is longer, not an error of start(). The
// driver goes on trying to get it back, and reports kStreaming with the next frame. Frames lost
// are counted. A damaged or short frame is lost, never handed out.
class Camera {
 public:
  using Sink = std::function<void(CameraEvent)>;

  virtual ~Camera() = default;  // stops

  // Fails, with a sentence, where waiting cannot help: no right to open the device, not a camera,
  // held by another program; a size or format that the camera does not have; or when started.
  virtual Status start(const CameraOptions& options, Sink sink) = 0;
  virtual void stop() = 0;

  // A new bound on blur, from climb rate and ground sample; holds from one of the next frames on.
  virtual void limit_exposure(std::chrono::microseconds longest) = 0;

  // What there is, streaming or not.
  virtual Result<CameraDescription> describe() = 0;
};

}  // namespace plumbline
