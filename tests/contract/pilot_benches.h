// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tests/contract/pilot_link_contract.h"

namespace plumbline::contract {

// The real driver on a pseudo-terminal; on a port of this machine, where the vehicle speaks first;
// and on one where the driver does.
std::unique_ptr<PilotBench> make_pty_pilot_bench();
std::unique_ptr<PilotBench> make_listening_pilot_bench();
std::unique_ptr<PilotBench> make_speaking_pilot_bench();

// The fake, on a virtual clock.
std::unique_ptr<PilotBench> make_recording_pilot_bench();

}  // namespace plumbline::contract
