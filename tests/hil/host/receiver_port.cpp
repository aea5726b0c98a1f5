// SPDX-License-Identifier: MIT
#include "tests/hil/host/receiver_port.h"

#include <sys/socket.h>

#include <array>
#include <utility>

namespace plumbline::hil {
namespace {

// What was said while nobody listened is gone.
constexpr std::chrono::milliseconds kOld(200);

}  // namespace

ReceiverPort::ReceiverPort(posix::Descriptor socket, sim::LineSource source)
    : socket_(std::move(socket)), source_(std::move(source)) {
  // The least that the system allows: what waits in it while the cable is out comes too late.
  const int bytes = 1;
  ::setsockopt(socket_.get(), SOL_SOCKET, SO_SNDBUF, &bytes, sizeof bytes);
  thread_ = std::jthread([this](const std::stop_token& stop) { play(stop); });
}

ReceiverPort::~ReceiverPort() {
  thread_.request_stop();
  signal_.raise();
}

void ReceiverPort::play(const std::stop_token& stop) {
  while (const auto piece = source_()) {
    while (!stop.stop_requested() && clock_.now() < piece->time) clock_.wait(signal_, piece->time);
    if (stop.stop_requested()) return;
    ignore_guest();
    if (clock_.now() - piece->time > kOld) continue;
    ::send(socket_.get(), piece->bytes.data(), piece->bytes.size(), MSG_DONTWAIT | MSG_NOSIGNAL);
  }
}

// A port that was just opened echoes for a moment, byte by byte, and QEMU stands still with all of
// its machine while a few hundred of such pieces wait here.
void ReceiverPort::ignore_guest() {
  std::array<char, 4096> bytes{};
  while (::recv(socket_.get(), bytes.data(), bytes.size(), MSG_DONTWAIT) > 0) {
  }
}

}  // namespace plumbline::hil
