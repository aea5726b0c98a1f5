// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>

#include "tests/contract/camera_contract.h"

namespace plumbline::contract {

// A camera of this machine: `id` is a video device ("/dev/video0") or "libcamera:ID". Its faults
// come from the controls of the kernel's test driver vivid, where it is one, and from shell
// commands in the environment:
//   PLUMBLINE_TEST_CAMERA_UNPLUG, PLUMBLINE_TEST_CAMERA_REPLUG    a pulled plug, put back
//   PLUMBLINE_TEST_CAMERA_SILENCE, PLUMBLINE_TEST_CAMERA_SPEAK    no frames, and frames again
//   PLUMBLINE_TEST_CAMERA_PULLS   how often it is unplugged in a row (50)
//   PLUMBLINE_TEST_CAMERA_SIZE    WIDTHxHEIGHT to stream in (640x360)
std::unique_ptr<CameraBench> make_kernel_camera_bench(const std::string& id);

}  // namespace plumbline::contract
