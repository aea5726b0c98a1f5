// SPDX-License-Identifier: MIT
#pragma once

#include <memory>

#include "tests/contract/camera_contract.h"

namespace plumbline::contract {

// Cameras on a virtual clock: one of which all faults are at hand, and one that is replayed.
std::unique_ptr<CameraBench> make_simulated_camera_bench();
std::unique_ptr<CameraBench> make_replayed_camera_bench();

}  // namespace plumbline::contract
