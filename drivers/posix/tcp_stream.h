// SPDX-License-Identifier: MIT
#pragma once

#include <netdb.h>

#include <string>

#include "drivers/posix/polled_stream.h"

namespace plumbline::posix {

// The bytes that a host sends to whoever connects (Reach: "position output", TCP server). A host
// that vanishes without a word (its power cut) is noticed within about five seconds of silence.
class TcpStream : public PolledStream {
 public:
  TcpStream(std::string host, std::string port) : host_(std::move(host)), port_(std::move(port)) {}

  Opening open() override;
  std::string name() const override { return "tcp://" + host_ + ":" + port_; }

 private:
  ssize_t put(std::string_view bytes) const override;
  std::string why_gone(int fault) const override;
  int connect_to(const addrinfo& address);
  int finish_connecting();
  Opening not_reached(const std::string& why) const;

  std::string host_;
  std::string port_;
};

}  // namespace plumbline::posix
