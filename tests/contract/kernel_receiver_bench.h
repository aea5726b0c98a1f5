// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tests/contract/gnss_receiver_contract.h"

namespace plumbline::contract {

// The real driver on a serial port of this machine. The environment says which:
// PLUMBLINE_TEST_SERIAL is the port that is read, PLUMBLINE_TEST_SERIAL_FAR a device whose bytes
// arrive there, PLUMBLINE_TEST_SERIAL_PULL and PLUMBLINE_TEST_SERIAL_PLUG are commands that take
// the port away and bring it back; it is away at first.
// Empty where it says nothing.
std::unique_ptr<ReceiverBench> make_kernel_receiver_bench();

}  // namespace plumbline::contract
