// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <vector>

#include "drivers/byte_stream.h"

namespace plumbline::posix {

// The serial ports of the system in the order of their names, with what their USB devices say of
// themselves. Pseudo-terminals, consoles and UARTs that the board does not have are left out.
// `sys` is where sysfs is mounted. Never fails: what cannot be read is not listed, or empty.
std::vector<SerialPortInfo> list_serial_ports(const std::filesystem::path& sys = "/sys");

}  // namespace plumbline::posix
