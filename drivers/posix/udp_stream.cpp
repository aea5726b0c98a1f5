// SPDX-License-Identifier: MIT
#include "drivers/posix/udp_stream.h"

#include <cerrno>
#include <cstring>
#include <memory>

namespace plumbline::posix {
namespace {

// Of the two kinds of address the first that the name has.
addrinfo wanted_address(bool to_listen) {
  addrinfo wanted{};
  wanted.ai_socktype = SOCK_DGRAM;
  wanted.ai_flags = to_listen ? AI_PASSIVE : 0;
  return wanted;
}

}  // namespace

ByteStream::Opening UdpStream::open() {
  close();
  other_size_ = 0;
  const addrinfo wanted = wanted_address(role_ == Role::kListens);
  addrinfo* found = nullptr;
  const int failed = ::getaddrinfo(host_.c_str(), port_.c_str(), &wanted, &found);
  if (failed == EAI_SERVICE) {
    return {Presence::kRefused, name() + " names no port: write udp://HOST:PORT with a number."};
  }
  if (failed != 0) {
    return {Presence::kAbsent, name() + " is not known here (" + ::gai_strerror(failed) +
                                   "): check the name and the network; it is tried again."};
  }
  const std::unique_ptr<addrinfo, decltype(&::freeaddrinfo)> address(found, &::freeaddrinfo);
  const int fault = take_address(*address);
  if (fault == 0) return {Presence::kOpen, {}};
  close();
  return not_open(fault);
}

int UdpStream::take_address(const addrinfo& address) {
  descriptor_ = Descriptor(
      ::socket(address.ai_family, SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, IPPROTO_UDP));
  if (!descriptor_.is_open()) return errno;
  if (role_ == Role::kListens) {
    return ::bind(descriptor_.get(), address.ai_addr, address.ai_addrlen) == 0 ? 0 : errno;
  }
  std::memcpy(&other_, address.ai_addr, address.ai_addrlen);
  other_size_ = address.ai_addrlen;
  return 0;
}

ByteStream::Opening UdpStream::not_open(int fault) const {
  if (fault == EADDRINUSE) {
    return {Presence::kRefused, name() +
                                    " is taken by another program: end that one first, or "
                                    "choose another port."};
  }
  if (fault == EACCES) {
    return {Presence::kRefused, name() +
                                    " may not be opened by this user: choose a port above "
                                    "1023."};
  }
  return {Presence::kAbsent, name() + " cannot be opened (" + std::strerror(fault) +
                                 "): check the network of this machine; it is tried again."};
}

// A datagram of nothing is no end, as it is of a stream.
ssize_t UdpStream::get(char* buffer, std::size_t size) {
  sockaddr_storage from{};
  socklen_t from_size = sizeof from;
  const ssize_t count = ::recvfrom(descriptor_.get(), buffer, size, 0,
                                   reinterpret_cast<sockaddr*>(&from), &from_size);
  if (count < 0) return count;
  other_ = from;
  other_size_ = from_size;
  if (count > 0) return count;
  errno = EAGAIN;
  return -1;
}

ssize_t UdpStream::put(std::string_view bytes) const {
  if (other_size_ == 0) return 0;
  return ::sendto(descriptor_.get(), bytes.data(), bytes.size(), MSG_NOSIGNAL,
                  reinterpret_cast<const sockaddr*>(&other_), other_size_);
}

std::string UdpStream::why_gone(int fault) const {
  return std::string("fails: ") + std::strerror(fault) + "; it is opened again.";
}

}  // namespace plumbline::posix
