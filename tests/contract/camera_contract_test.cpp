// SPDX-License-Identifier: MIT
#include "tests/contract/camera_contract.h"

#include <cstdlib>
#include <string>
#include <vector>

#include "tests/contract/kernel_camera_bench.h"
#include "tests/contract/simulated_camera_bench.h"

namespace plumbline::contract {
namespace {

std::string name_of(const testing::TestParamInfo<NamedCameraBench>& info) {
  return info.param.name;
}

// The camera that the environment names. One process drives one: run it again for another.
NamedCameraBench kernel_camera() {
  const char* id = std::getenv("PLUMBLINE_TEST_CAMERA");
  if (id == nullptr || *id == '\0') {
    return {"OfThisMachine", nullptr,
            "PLUMBLINE_TEST_CAMERA names no camera (as /dev/video0): none is tested"};
  }
  return {"OfThisMachine", [id = std::string(id)] { return make_kernel_camera_bench(id); }, ""};
}

INSTANTIATE_TEST_SUITE_P(
    Camera, CameraContract,
    testing::Values(NamedCameraBench{"Simulated", make_simulated_camera_bench, ""},
                    NamedCameraBench{"Replayed", make_replayed_camera_bench, ""}, kernel_camera()),
    name_of);

}  // namespace
}  // namespace plumbline::contract
