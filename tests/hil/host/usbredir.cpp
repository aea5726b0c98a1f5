// SPDX-License-Identifier: MIT
#include "tests/hil/host/usbredir.h"

#include <poll.h>
#include <sys/socket.h>
#include <sys/un.h>

#include <array>
#include <thread>

namespace plumbline::hil {
namespace {

using std::chrono::milliseconds;

// connect_device_version, ep_info_max_packet_size, 64bits_ids, 32bits_bulk_length.
constexpr std::uint32_t kCapabilities = 1U << 1 | 1U << 4 | 1U << 5 | 1U << 6;
constexpr std::size_t kHelloHeader = 12;  // ids have 4 bytes until both sides have said hello
constexpr std::size_t kHeader = 16;

}  // namespace

posix::Descriptor connect_to(const std::string& path) {
  sockaddr_un address{};
  address.sun_family = AF_UNIX;
  if (path.size() >= sizeof address.sun_path) return {};
  path.copy(address.sun_path, path.size());
  posix::Descriptor socket(::socket(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0));
  const auto* generic = reinterpret_cast<const sockaddr*>(&address);
  if (::connect(socket.get(), generic, sizeof address) != 0) socket.close();
  return socket;
}

posix::Descriptor connect_patiently(const std::string& path) {
  posix::Descriptor socket = connect_to(path);
  for (int tries = 0; tries < 300 && !socket.is_open(); ++tries) {
    std::this_thread::sleep_for(milliseconds(100));
    socket = connect_to(path);
  }
  return socket;
}

std::uint64_t number_at(std::string_view bytes, std::size_t at, int count) {
  std::uint64_t value = 0;
  for (int i = count - 1; i >= 0; --i) {
    const std::size_t index = at + static_cast<std::size_t>(i);
    value = value << 8 | (index < bytes.size() ? static_cast<unsigned char>(bytes[index]) : 0U);
  }
  return value;
}

bool RedirLink::open(const std::string& socket_path) {
  socket_ = connect_patiently(socket_path);
  return socket_.is_open() && greet();
}

bool RedirLink::greet() {
  std::string name = "plumbline bench";
  name.resize(64);
  const Bytes hello = Bytes().u32(0).u32(68).u32(0).add(name).u32(kCapabilities);
  if (!write(hello.str())) return false;
  std::optional<RedirPacket> answer;
  while (!answer && fill(milliseconds(30000))) answer = take(kHelloHeader);
  return answer && (number_at(answer->payload, 64, 4) & kCapabilities) == kCapabilities;
}

bool RedirLink::send(Redir type, std::uint64_t id, std::string_view payload) {
  return write(
      Bytes().u32(static_cast<std::uint32_t>(type)).u32(payload.size()).u64(id).add(payload).str());
}

std::optional<RedirPacket> RedirLink::receive(milliseconds at_most) {
  auto packet = take(kHeader);
  while (!packet && fill(at_most)) packet = take(kHeader);
  return packet;
}

std::optional<RedirPacket> RedirLink::take(std::size_t header) {
  if (received_.size() < header) return std::nullopt;
  const std::size_t length = number_at(received_, 4, 4);
  if (received_.size() < header + length) return std::nullopt;
  RedirPacket packet{static_cast<Redir>(number_at(received_, 0, 4)),
                     number_at(received_, 8, static_cast<int>(header) - 8),
                     received_.substr(header, length)};
  received_.erase(0, header + length);
  return packet;
}

bool RedirLink::fill(milliseconds at_most) {
  if (!socket_.is_open()) return false;
  pollfd wait{socket_.get(), POLLIN, 0};
  if (::poll(&wait, 1, static_cast<int>(at_most.count())) <= 0) return false;
  std::array<char, 65536> buffer{};
  const ssize_t count = ::recv(socket_.get(), buffer.data(), buffer.size(), 0);
  if (count <= 0) {
    socket_.close();
    return false;
  }
  received_.append(buffer.data(), static_cast<std::size_t>(count));
  return true;
}

bool RedirLink::write(std::string_view bytes) {
  while (socket_.is_open() && !bytes.empty()) {
    const ssize_t count = ::send(socket_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (count <= 0) socket_.close();
    if (count > 0) bytes.remove_prefix(static_cast<std::size_t>(count));
  }
  return socket_.is_open();
}

}  // namespace plumbline::hil
