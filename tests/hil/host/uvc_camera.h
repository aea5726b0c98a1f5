// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <string>
#include <utility>

#include "sim/random.h"
#include "tests/hil/host/usbredir.h"
#include "tests/hil/host/uvc_descriptors.h"

namespace plumbline::hil {

// What the guest has set, in USB Video Class's units.
struct UvcSettings {
  std::uint64_t exposure_100us = 156;
  std::uint64_t gain = 10;
  bool automatic = true;
};

struct UvcExposure {
  UvcSettings set;
  std::chrono::steady_clock::time_point middle;
};

// One frame of YUY2.
using UvcPicture = std::function<std::string(const UvcExposure& exposure)>;

// What is done to it, from another thread.
struct UvcOrders {
  std::atomic<bool> plugged{true};
  std::atomic<bool> silent{false};  // no frame comes
  // From a frame's exposure to its first byte: for each frame another time, up to this.
  std::atomic<int> longest_delay_ms{0};
};

// A USB camera that exists only in this program: plugs itself into QEMU's usb-redir device and
// streams to the guest's own driver (uvcvideo) until QEMU ends. Its sensor runs freely, whether it
// streams or not: the middles of its exposures are UvcMode's moments. One thread.
class UvcCamera {
 public:
  UvcCamera(RedirLink& link, UvcMode mode, UvcPicture picture, const UvcOrders& orders);

  void run();

 private:
  using SteadyTime = std::chrono::steady_clock::time_point;
  struct Answer {
    bool stall = false;  // the guest asked for what there is not
    std::string bytes;
  };
  struct Control {
    int size = 0;
    std::uint64_t least = 0, most = 0, step = 0, usual = 0, now = 0;
  };
  struct Image {
    std::string bytes;
    SteadyTime ready;  // to be sent
  };
  struct Transfer {
    std::uint64_t id = 0;
    std::size_t bytes = 0;
  };

  void plug_in();
  void unplug();
  void forget_images();
  void send_endpoints();
  void take(const RedirPacket& packet);
  void take_control(const RedirPacket& packet);
  void take_cancel(std::uint64_t id);
  Answer answer(std::string_view request);
  Answer describe(unsigned kind, unsigned index) const;
  Answer negotiate(unsigned request, std::string_view bytes);
  Answer control(Control& control, unsigned request, std::string_view bytes) const;
  UvcSettings settings() const;
  std::string negotiated() const;

  void feed();
  SteadyTime next_exposure() const;
  void expose(SteadyTime now);
  void complete(Transfer transfer);
  std::chrono::milliseconds until_next_frame() const;

  RedirLink& link_;
  const UvcMode mode_;
  const UvcPicture picture_;
  const UvcOrders& orders_;
  std::map<std::pair<unsigned, unsigned>, Control> controls_;  // by entity and selector
  std::deque<Transfer> waiting_;
  std::deque<Image> images_;  // exposed; the first is being sent
  std::size_t sent_ = 0;      // of its bytes
  SteadyTime next_middle_{};
  sim::Random random_{20261128, 1};
  std::uint64_t frames_ = 0;  // sent whole
  bool plugged_ = false;
};

}  // namespace plumbline::hil
