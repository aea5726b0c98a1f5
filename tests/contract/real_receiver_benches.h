// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tests/contract/gnss_receiver_contract.h"

namespace plumbline::contract {

// The real driver on a pseudo-terminal, and on a host that listens on this machine.
std::unique_ptr<ReceiverBench> make_pty_bench();
std::unique_ptr<ReceiverBench> make_tcp_bench();

// The real driver on a port of the kernel's, as the environment says:
//   PLUMBLINE_TEST_SERIAL        the port, "/dev/ttyUSB0"
//   PLUMBLINE_TEST_SERIAL_FAR    what is written to this device arrives at the port
//   PLUMBLINE_TEST_SERIAL_PLUG, PLUMBLINE_TEST_SERIAL_PULL    shell commands that have the cable
//                                                             plugged in, and pulled, when they end
std::unique_ptr<ReceiverBench> make_kernel_port_bench();

}  // namespace plumbline::contract
