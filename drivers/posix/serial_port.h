// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "drivers/posix/polled_stream.h"

namespace plumbline::posix {

// A serial port: USB of either kind (CDC-ACM as Reach has it, or an adapter: FTDI, PL2303), a UART,
// or a pseudo-terminal. Opened for this process alone (TIOCEXCL, and flock for root), raw, eight
// data bits, no parity, no flow control. Found again when its node returns under the same path.
class SerialPort : public PolledStream {
 public:
  explicit SerialPort(std::string path, int baud = 115200) : path_(std::move(path)), baud_(baud) {}

  Opening open() override;
  std::vector<int> speeds() const override;
  Status set_speed(int baud) override;
  std::string name() const override { return path_; }

 private:
  std::string why_gone(int fault) const override;
  Opening not_open(int fault) const;
  int make_ours();
  int make_raw();

  std::string path_;
  int baud_;
};

}  // namespace plumbline::posix
