// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "drivers/posix/descriptor.h"

namespace plumbline::hil {

// Appends little-endian numbers, as USB and usbredir have them.
class Bytes {
 public:
  Bytes& u8(unsigned value) { return put(value, 1); }
  Bytes& u16(unsigned value) { return put(value, 2); }
  Bytes& u32(std::uint64_t value) { return put(value, 4); }
  Bytes& u64(std::uint64_t value) { return put(value, 8); }
  Bytes& add(std::string_view bytes) {
    bytes_ += bytes;
    return *this;
  }
  const std::string& str() const { return bytes_; }

 private:
  Bytes& put(std::uint64_t value, int count) {
    for (; count > 0; --count, value >>= 8) bytes_ += static_cast<char>(value & 0xff);
    return *this;
  }
  std::string bytes_;
};

// The little-endian number of `count` bytes at `at`; bytes beyond the end are 0.
std::uint64_t number_at(std::string_view bytes, std::size_t at, int count);

// Closed where nobody listens there.
posix::Descriptor connect_to(const std::string& socket_path);
// The same, tried for 30 s: QEMU makes its sockets in its own time.
posix::Descriptor connect_patiently(const std::string& socket_path);

// Packets of the usbredir protocol (its document: usb-redirection-protocol.md of usbredir).
enum class Redir : std::uint32_t {
  kHello = 0,
  kConnect = 1,
  kDisconnect = 2,
  kReset = 3,
  kInterfaces = 4,
  kEndpoints = 5,
  kSetConfiguration = 6,
  kGetConfiguration = 7,
  kConfiguration = 8,
  kSetAlternate = 9,
  kGetAlternate = 10,
  kAlternate = 11,
  kCancel = 21,
  kControl = 100,
  kBulk = 101
};

struct RedirPacket {
  Redir type = Redir::kHello;
  std::uint64_t id = 0;
  std::string payload;
};

// The socket to QEMU's usb-redir device. The device's side of the protocol. One thread.
class RedirLink {
 public:
  // Connects and greets, trying for 30 s; false where it cannot.
  bool open(const std::string& socket_path);

  bool send(Redir type, std::uint64_t id, std::string_view payload);

  // The next packet, or nothing when `at_most` is over or QEMU has gone (then is_open() is false).
  std::optional<RedirPacket> receive(std::chrono::milliseconds at_most);

  bool is_open() const { return socket_.is_open(); }

 private:
  bool greet();
  bool fill(std::chrono::milliseconds at_most);
  std::optional<RedirPacket> take(std::size_t header);
  bool write(std::string_view bytes);

  posix::Descriptor socket_;
  std::string received_;
};

}  // namespace plumbline::hil
