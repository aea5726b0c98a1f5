// SPDX-License-Identifier: MIT
#pragma once

#include <netdb.h>
#include <sys/socket.h>

#include <string>

#include "drivers/posix/polled_stream.h"

namespace plumbline::posix {

// Datagrams to and from one other at a time: what is written goes to whoever spoke last. It either
// waits at a port of this machine to be spoken to, or speaks first, to a given host. It cannot tell
// an other who is silent from one who is not there.
class UdpStream : public PolledStream {
 public:
  enum class Role {
    kListens,  // at host:port of this machine ("0.0.0.0": at all its addresses)
    kSpeaks    // to host:port
  };

  UdpStream(Role role, std::string host, std::string port)
      : role_(role), host_(std::move(host)), port_(std::move(port)) {}

  Opening open() override;
  std::string name() const override { return "udp://" + host_ + ":" + port_; }

 private:
  ssize_t get(char* buffer, std::size_t size) override;
  ssize_t put(std::string_view bytes) const override;
  std::string why_gone(int fault) const override;
  int take_address(const addrinfo& address);
  Opening not_open(int fault) const;

  Role role_;
  std::string host_;
  std::string port_;
  sockaddr_storage other_{};
  socklen_t other_size_ = 0;  // 0: nobody has spoken yet
};

}  // namespace plumbline::posix
