// SPDX-License-Identifier: MIT
#include "tests/hil/host/uvc_camera.h"

#include <algorithm>

namespace plumbline::hil {
namespace {

using std::chrono::milliseconds;

// Requests of USB Video Class 1.0, A.8.
enum Request {
  kSetCur = 0x01,
  kGetCur = 0x81,
  kGetMin,
  kGetMax,
  kGetRes,
  kGetLen,
  kGetInfo,
  kGetDef
};

constexpr std::pair kExposureMode{kUvcCameraTerminal, 2U};
constexpr std::pair kExposureTime{kUvcCameraTerminal, 4U};
constexpr std::pair kBrightness{kUvcProcessingUnit, 2U};
constexpr std::pair kGain{kUvcProcessingUnit, 4U};
constexpr unsigned kManual = 1;
constexpr unsigned kAperturePriority = 8;
constexpr int kProbeBytes = 26;

// usbredir's status of a transfer.
constexpr unsigned kSuccess = 0;
constexpr unsigned kCancelled = 1;
constexpr unsigned kStall = 4;

std::string bulk_header(unsigned status, std::size_t bytes) {
  return Bytes()
      .u8(kUvcEndpoint)
      .u8(status)
      .u16(static_cast<unsigned>(bytes & 0xffff))
      .u32(0)
      .u16(static_cast<unsigned>(bytes >> 16))
      .str();
}

std::string of_32(std::initializer_list<unsigned> first) {
  std::string bytes;
  for (const unsigned value : first) bytes += static_cast<char>(value);
  bytes.resize(32);
  return bytes;
}

}  // namespace

UvcCamera::UvcCamera(RedirLink& link, UvcMode mode, UvcPicture picture, const UvcOrders& orders)
    : link_(link), mode_(mode), picture_(std::move(picture)), orders_(orders) {
  controls_[kExposureMode] = {
      1, 1, 8, kManual | kAperturePriority, kAperturePriority, kAperturePriority};
  controls_[kExposureTime] = {4, 1, 10000, 1, 156, 156};
  controls_[kBrightness] = {2, 0, 255, 1, 128, 128};
  controls_[kGain] = {2, 0, 100, 1, 10, 10};
}

void UvcCamera::run() {
  while (link_.is_open()) {
    if (orders_.plugged != plugged_) plugged_ ? unplug() : plug_in();
    if (const auto packet = link_.receive(until_next_frame())) take(*packet);
    feed();
  }
}

void UvcCamera::unplug() {
  link_.send(Redir::kDisconnect, 0, "");
  waiting_.clear();
  forget_images();
  plugged_ = false;
}

void UvcCamera::forget_images() {
  images_.clear();
  sent_ = 0;
}

void UvcCamera::plug_in() {
  send_endpoints();
  link_.send(Redir::kInterfaces, 0,
             Bytes()
                 .u32(2)
                 .add(of_32({0, 1}))
                 .add(of_32({14, 14}))
                 .add(of_32({1, 2}))
                 .add(of_32({}))
                 .str());
  // Speed 2: high.
  link_.send(Redir::kConnect, 0,
             Bytes().u8(2).u8(0xef).u8(2).u8(1).u16(kUvcVendor).u16(kUvcProduct).u16(0x0100).str());
  plugged_ = true;
}

// Of 16 endpoints out, then 16 in: type, interval, interface, longest packet.
void UvcCamera::send_endpoints() {
  constexpr std::size_t kIn1 = 17;
  std::string types(32, '\xff');
  types[0] = types[16] = 0;
  types[kIn1] = 2;
  std::string interfaces(32, '\0');
  interfaces[kIn1] = 1;
  Bytes info;
  info.add(types).add(std::string(32, '\0')).add(interfaces);
  for (std::size_t i = 0; i < 32; ++i) info.u16(i == kIn1 ? kUvcPacketBytes : i % 16 == 0 ? 64 : 0);
  link_.send(Redir::kEndpoints, 0, info.str());
}

void UvcCamera::take(const RedirPacket& packet) {
  const unsigned first = static_cast<unsigned>(number_at(packet.payload, 0, 1));
  switch (packet.type) {
    case Redir::kControl:
      return take_control(packet);
    case Redir::kBulk:
      waiting_.push_back(
          {packet.id, number_at(packet.payload, 2, 2) | number_at(packet.payload, 8, 2) << 16});
      return;
    case Redir::kCancel:
      return take_cancel(packet.id);
    case Redir::kSetConfiguration:
      send_endpoints();
      link_.send(Redir::kConfiguration, packet.id, Bytes().u8(0).u8(first).str());
      return;
    case Redir::kGetConfiguration:
      link_.send(Redir::kConfiguration, packet.id, Bytes().u8(0).u8(1).str());
      return;
    case Redir::kSetAlternate:
    case Redir::kGetAlternate:
      link_.send(Redir::kAlternate, packet.id, Bytes().u8(0).u8(first).u8(0).str());
      return;
    case Redir::kReset:
      waiting_.clear();
      forget_images();
      return;
    default:
      return;
  }
}

void UvcCamera::take_control(const RedirPacket& packet) {
  const auto field = [&](std::size_t at, int count) {
    return static_cast<unsigned>(number_at(packet.payload, at, count));
  };
  Answer answered = answer(packet.payload);
  const bool to_host = (field(2, 1) & 0x80) != 0;
  const unsigned asked = field(8, 2);
  answered.bytes.resize(std::min<std::size_t>(answered.bytes.size(), asked));
  const unsigned bytes = to_host ? static_cast<unsigned>(answered.bytes.size()) : asked;
  link_.send(Redir::kControl, packet.id,
             Bytes()
                 .u8(field(0, 1))
                 .u8(field(1, 1))
                 .u8(field(2, 1))
                 .u8(answered.stall ? kStall : kSuccess)
                 .u16(field(4, 2))
                 .u16(field(6, 2))
                 .u16(bytes)
                 .add(answered.bytes)
                 .str());
}

// In `request`: endpoint, request, type, status, value, index, length, then bytes to the camera.
UvcCamera::Answer UvcCamera::answer(std::string_view request) {
  const auto field = [&](std::size_t at) {
    return static_cast<unsigned>(number_at(request, at, 1));
  };
  const unsigned code = field(1), type = field(2), selector = field(5);
  const unsigned interface = field(6), entity = field(7);
  const std::string_view bytes = request.substr(std::min<std::size_t>(10, request.size()));
  if (type == 0x80 && code == 6) return describe(selector, field(4));
  if (type == 0x80 && code == 0) return {false, std::string(2, '\0')};
  if (type <= 2) return {};
  if (interface == 1 && (selector == 1 || selector == 2)) return negotiate(code, bytes);
  const auto found = controls_.find({entity, selector});
  if (interface == 0 && found != controls_.end()) return control(found->second, code, bytes);
  return {true, ""};
}

UvcCamera::Answer UvcCamera::describe(unsigned kind, unsigned index) const {
  if (kind == 1) return {false, uvc_device_descriptor()};
  if (kind == 2) return {false, uvc_configuration(mode_)};
  const std::string text = kind == 3 ? uvc_string(index) : "";
  return {text.empty(), text};
}

// There is one mode: whatever is asked for, it is the answer.
UvcCamera::Answer UvcCamera::negotiate(unsigned request, std::string_view /*bytes*/) {
  if (request == kSetCur) return {};
  if (request == kGetLen) return {false, Bytes().u16(kProbeBytes).str()};
  if (request == kGetInfo) return {false, Bytes().u8(3).str()};
  return {false, negotiated()};
}

std::string UvcCamera::negotiated() const {
  return Bytes()
      .u16(1)
      .u8(1)
      .u8(1)
      .u32(mode_.interval_100ns())
      .u32(0)
      .u32(0)
      .u16(0)
      .u32(mode_.frame_bytes())
      .u32(kUvcPayloadBytes)
      .str();
}

UvcCamera::Answer UvcCamera::control(Control& control, unsigned request,
                                     std::string_view bytes) const {
  const auto value = [&](std::uint64_t number) {
    return Answer{false,
                  Bytes().u64(number).str().substr(0, static_cast<std::size_t>(control.size))};
  };
  switch (request) {
    case kSetCur:
      control.now = number_at(bytes, 0, control.size);
      return {};
    case kGetCur:
      return value(control.now);
    case kGetMin:
      return value(control.least);
    case kGetMax:
      return value(control.most);
    case kGetRes:
      return value(control.step);
    case kGetDef:
      return value(control.usual);
    case kGetLen:
      return {false, Bytes().u16(static_cast<unsigned>(control.size)).str()};
    case kGetInfo:
      return {false, Bytes().u8(3).str()};
    default:
      return {true, ""};
  }
}

UvcSettings UvcCamera::settings() const {
  return {controls_.at(kExposureTime).now, controls_.at(kGain).now,
          controls_.at(kExposureMode).now != kManual};
}

void UvcCamera::take_cancel(std::uint64_t id) {
  const auto found = std::find_if(waiting_.begin(), waiting_.end(),
                                  [id](const Transfer& transfer) { return transfer.id == id; });
  if (found == waiting_.end()) return;
  waiting_.erase(found);
  link_.send(Redir::kBulk, id, bulk_header(kCancelled, 0));
  if (waiting_.empty()) forget_images();  // the stream is over: a new one begins with a new frame
}

milliseconds UvcCamera::until_next_frame() const {
  constexpr milliseconds kOrders(20);  // looked at so often
  if (waiting_.empty()) return kOrders;
  SteadyTime next = next_exposure();
  if (!images_.empty()) next = std::min(next, images_.front().ready);
  const auto left = std::chrono::ceil<milliseconds>(next - std::chrono::steady_clock::now());
  return std::clamp(left, milliseconds(0), kOrders);
}

void UvcCamera::feed() {
  while (plugged_ && link_.is_open() && !waiting_.empty()) {
    const SteadyTime now = std::chrono::steady_clock::now();
    if (now >= next_exposure()) expose(now);
    if (images_.empty() || now < images_.front().ready) return;
    const Transfer transfer = waiting_.front();
    waiting_.pop_front();
    complete(transfer);
  }
}

UvcCamera::SteadyTime UvcCamera::next_exposure() const {
  return next_middle_ - std::chrono::microseconds(100) * settings().exposure_100us / 2;
}

// Exposes while earlier images wait.
void UvcCamera::expose(SteadyTime now) {
  constexpr std::size_t kMostImages = 4;
  const SteadyTime middle = next_middle_;
  const bool missed = now - middle > mode_.interval();
  next_middle_ = mode_.moment_after(missed ? now : middle);
  if (missed || orders_.silent || images_.size() >= kMostImages) return;
  const UvcSettings set = settings();
  const auto exposure = std::chrono::microseconds(100) * set.exposure_100us;
  const auto delay = random_.uniform() * milliseconds(orders_.longest_delay_ms);
  images_.push_back(
      {picture_({set, middle}),
       middle + exposure / 2 + std::chrono::duration_cast<std::chrono::nanoseconds>(delay)});
}

// A payload: its header (length; bits for which frame and its end), then a part of the frame.
void UvcCamera::complete(Transfer transfer) {
  const std::size_t room = std::min<std::size_t>(transfer.bytes, kUvcPayloadBytes) - 2;
  const std::string_view part = std::string_view(images_.front().bytes).substr(sent_, room);
  sent_ += part.size();
  const bool last = sent_ >= images_.front().bytes.size();
  const unsigned bits = 0x80U | static_cast<unsigned>(frames_ & 1) | (last ? 2U : 0U);
  link_.send(Redir::kBulk, transfer.id,
             Bytes().add(bulk_header(kSuccess, part.size() + 2)).u8(2).u8(bits).add(part).str());
  if (!last) return;
  images_.pop_front();
  sent_ = 0;
  ++frames_;
}

}  // namespace plumbline::hil
