// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tests/contract/gnss_receiver_contract.h"

namespace plumbline::contract {

// The simulated receiver, and a replayed one whose recording is written as it is played.
std::unique_ptr<ReceiverBench> make_simulated_receiver_bench();
std::unique_ptr<ReceiverBench> make_replayed_receiver_bench();

}  // namespace plumbline::contract
