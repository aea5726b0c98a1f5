// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tests/contract/gnss_receiver_contract.h"

namespace plumbline::contract {

// The real driver on a pseudo-terminal, and on a host that listens on this machine.
std::unique_ptr<ReceiverBench> make_pty_bench();
std::unique_ptr<ReceiverBench> make_tcp_bench();

}  // namespace plumbline::contract
