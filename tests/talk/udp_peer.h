// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>
#include <string_view>

namespace plumbline::talk {

// A socket of this machine (127.0.0.1) that datagrams are sent from and received at.
class UdpPeer {
 public:
  explicit UdpPeer(int port = 0);  // 0: one that is free
  UdpPeer(const UdpPeer&) = delete;
  UdpPeer& operator=(const UdpPeer&) = delete;
  ~UdpPeer();

  int port() const;
  void send_to(int port, std::string_view bytes);

  // The next datagram; empty where none comes in time.
  std::string receive(std::chrono::milliseconds at_most);

  int sender_port() const { return sender_port_; }  // of the datagram received last

 private:
  int fd_;
  int sender_port_ = 0;
};

}  // namespace plumbline::talk
