// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "drivers/byte_stream.h"
#include "drivers/clock.h"
#include "drivers/gnss_receiver.h"
#include "edge/base/result.h"

namespace plumbline {

// The real devices, each behind its seam. No other file of firmware/ knows what they are.

std::unique_ptr<Clock> make_clock();

// "/dev/ttyACM0", "/dev/ttyUSB0@38400" (without a speed it is found), "tcp://HOST:PORT", or the
// path of a log, which is played as fast as it is read. Fails where the address is none; whether
// the receiver is there is start()'s business. `clock` outlives the receiver.
Result<std::unique_ptr<GnssReceiver>> make_receiver(const std::string& address, const Clock& clock);

std::vector<SerialPortInfo> list_serial_ports();

}  // namespace plumbline
