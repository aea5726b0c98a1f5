// SPDX-License-Identifier: MIT
#include "drivers/posix/tcp_stream.h"

#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>

#include <cerrno>
#include <cstring>
#include <memory>

namespace plumbline::posix {
namespace {

constexpr std::chrono::milliseconds kConnectTime{1500};

void set(int fd, int level, int option, int value) {
  ::setsockopt(fd, level, option, &value, sizeof value);
}

// Asks a host that is silent for two seconds whether it is there, and gives up after three more.
void notice_a_vanished_host(int fd) {
  set(fd, SOL_SOCKET, SO_KEEPALIVE, 1);
  set(fd, IPPROTO_TCP, TCP_KEEPIDLE, 2);
  set(fd, IPPROTO_TCP, TCP_KEEPINTVL, 1);
  set(fd, IPPROTO_TCP, TCP_KEEPCNT, 3);
}

}  // namespace

ByteStream::Opening TcpStream::open() {
  close();
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_STREAM;
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(host_.c_str(), port_.c_str(), &wanted, &found);
  if (failed == EAI_SERVICE) {
    return {Presence::kRefused, name() + " names no port: write tcp://HOST:PORT with a number."};
  }
  if (failed != 0) return not_reached(::gai_strerror(failed));
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> addresses(found, &::freeaddrinfo);
  int fault = EADDRNOTAVAIL;
  for (const addrinfo* at = addresses.get(); at != nullptr && fault != 0; at = at->ai_next) {
    fault = connect_to(*at);
  }
  return fault == 0 ? Opening{Presence::kOpen, {}} : not_reached(std::strerror(fault));
}

int TcpStream::connect_to(const addrinfo& address) {
  descriptor_ = Descriptor(
      ::socket(address.ai_family, SOCK_STREAM | SOCK_NONBLOCK | SOCK_CLOEXEC, IPPROTO_TCP));
  int fault = descriptor_.is_open() ? 0 : errno;
  if (fault == 0 && ::connect(descriptor_.get(), address.ai_addr, address.ai_addrlen) != 0) {
    fault = errno == EINPROGRESS ? finish_connecting() : errno;
  }
  if (fault == 0) {
    notice_a_vanished_host(descriptor_.get());
  } else {
    close();
  }
  return fault;
}

int TcpStream::finish_connecting() {
  if (wait_.wait(descriptor_.get(), POLLOUT, kConnectTime) == 0) return ETIMEDOUT;
  int fault = 0;
  socklen_t size = sizeof fault;
  if (::getsockopt(descriptor_.get(), SOL_SOCKET, SO_ERROR, &fault, &size) != 0) return errno;
  return fault;
}

// A connection that was cut is an error here, not a signal that ends the program.
ssize_t TcpStream::put(std::string_view bytes) const {
  return ::send(descriptor_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL);
}

ByteStream::Opening TcpStream::not_reached(const std::string& why) const {
  return {Presence::kAbsent, name() + " does not answer (" + why +
                                 "): check that the receiver is on, in this network, and sends its "
                                 "position as a TCP server; it is tried again and again."};
}

std::string TcpStream::why_gone(int fault) const {
  const std::string why = fault == 0 ? "by the receiver" : std::strerror(fault);
  return "was cut (" + why + "): it is connected again as soon as the receiver answers.";
}

}  // namespace plumbline::posix
