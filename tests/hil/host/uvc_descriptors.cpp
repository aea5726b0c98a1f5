// SPDX-License-Identifier: MIT
#include "tests/hil/host/uvc_descriptors.h"

#include "tests/hil/host/usbredir.h"

namespace plumbline::hil {
namespace {

constexpr unsigned kInterface = 4;
constexpr unsigned kClassSpecific = 0x24;
constexpr unsigned kVideo = 0x0e;
constexpr std::string_view kYuy2 = {"YUY2\0\0\x10\0\x80\0\0\xaa\0\x38\x9b\x71", 16};

// A descriptor begins with its length.
std::string sized(const Bytes& body) {
  return Bytes().u8(static_cast<unsigned>(body.str().size() + 1)).add(body.str()).str();
}

std::string interface(unsigned number, unsigned endpoints, unsigned subclass) {
  return sized(
      Bytes().u8(kInterface).u8(number).u8(0).u8(endpoints).u8(kVideo).u8(subclass).u8(0).u8(0));
}

// Bits: auto exposure mode, exposure time (absolute).
std::string camera_terminal() {
  return sized(Bytes()
                   .u8(kClassSpecific)
                   .u8(2)
                   .u8(kUvcCameraTerminal)
                   .u16(0x0201)
                   .u8(0)
                   .u8(0)
                   .u16(0)
                   .u16(0)
                   .u16(0)
                   .u8(3)
                   .u8(0x0a)
                   .u8(0)
                   .u8(0));
}

// Bits: brightness, gain.
std::string processing_unit() {
  return sized(Bytes()
                   .u8(kClassSpecific)
                   .u8(5)
                   .u8(kUvcProcessingUnit)
                   .u8(kUvcCameraTerminal)
                   .u16(0)
                   .u8(2)
                   .u8(0x01)
                   .u8(0x02)
                   .u8(0));
}

std::string output_terminal() {
  return sized(
      Bytes().u8(kClassSpecific).u8(3).u8(3).u16(0x0101).u8(0).u8(kUvcProcessingUnit).u8(0));
}

std::string control_header(std::size_t total) {
  return sized(Bytes()
                   .u8(kClassSpecific)
                   .u8(1)
                   .u16(0x0100)
                   .u16(static_cast<unsigned>(total))
                   .u32(48'000'000)
                   .u8(1)
                   .u8(1));
}

std::string format() {
  return sized(Bytes().u8(kClassSpecific).u8(4).u8(1).u8(1).add(kYuy2).u8(16).u8(1).u32(0));
}

std::string frame(const UvcMode& mode) {
  const std::uint64_t bits_per_s =
      std::uint64_t{8} * mode.frame_bytes() * static_cast<unsigned>(mode.frames_per_s);
  return sized(Bytes()
                   .u8(kClassSpecific)
                   .u8(5)
                   .u8(1)
                   .u8(0)
                   .u16(static_cast<unsigned>(mode.width_px))
                   .u16(static_cast<unsigned>(mode.height_px))
                   .u32(bits_per_s)
                   .u32(bits_per_s)
                   .u32(mode.frame_bytes())
                   .u32(mode.interval_100ns())
                   .u8(1)
                   .u32(mode.interval_100ns()));
}

std::string stream_header(std::size_t total) {
  return sized(Bytes()
                   .u8(kClassSpecific)
                   .u8(1)
                   .u8(1)
                   .u16(static_cast<unsigned>(total))
                   .u8(kUvcEndpoint)
                   .u8(0)
                   .u8(3)
                   .u8(0)
                   .u8(0)
                   .u8(0)
                   .u8(1)
                   .u8(0));
}

// A header states the length of itself and of what follows it.
template <typename Header>
std::string headed(Header header, const std::string& rest) {
  return header(header(0).size() + rest.size()) + rest;
}

}  // namespace

std::string uvc_device_descriptor() {
  return sized(Bytes()
                   .u8(1)
                   .u16(0x0200)
                   .u8(0xef)
                   .u8(2)
                   .u8(1)
                   .u8(64)
                   .u16(kUvcVendor)
                   .u16(kUvcProduct)
                   .u16(0x0100)
                   .u8(1)
                   .u8(2)
                   .u8(0)
                   .u8(1));
}

std::string uvc_configuration(const UvcMode& mode) {
  const std::string association = sized(Bytes().u8(11).u8(0).u8(2).u8(kVideo).u8(3).u8(0).u8(0));
  const std::string endpoint =
      sized(Bytes().u8(5).u8(kUvcEndpoint).u8(2).u16(kUvcPacketBytes).u8(0));
  const std::string body =
      association + interface(0, 0, 1) +
      headed(control_header, camera_terminal() + processing_unit() + output_terminal()) +
      interface(1, 1, 2) + headed(stream_header, format() + frame(mode)) + endpoint;
  return sized(Bytes()
                   .u8(2)
                   .u16(static_cast<unsigned>(9 + body.size()))
                   .u8(2)
                   .u8(1)
                   .u8(0)
                   .u8(0x80)
                   .u8(250)) +
         body;
}

std::string uvc_string(unsigned index) {
  if (index == 0) return sized(Bytes().u8(3).u16(0x0409));
  if (index > 2) return "";
  Bytes text;
  text.u8(3);
  for (const char letter : std::string(index == 1 ? "Plumbline" : "Bench camera")) {
    text.u16(static_cast<unsigned char>(letter));
  }
  return sized(text);
}

}  // namespace plumbline::hil
