// SPDX-License-Identifier: MIT
#include "tests/contract/gnss_receiver_contract.h"

#include <cstdlib>

#include "tests/contract/real_receiver_benches.h"
#include "tests/contract/virtual_receiver_benches.h"

namespace plumbline::contract {
namespace {

// The port that the environment names.
NamedReceiverBench kernel_port() {
  if (std::getenv("PLUMBLINE_TEST_SERIAL") == nullptr) {
    return {"OfThisMachine", nullptr,
            "PLUMBLINE_TEST_SERIAL names no serial port (scripts/bench does): none is tested"};
  }
  return {"OfThisMachine", make_kernel_port_bench, ""};
}

INSTANTIATE_TEST_SUITE_P(
    Receivers, GnssReceiverContract,
    testing::Values(NamedReceiverBench{"Pty", make_pty_bench, ""},
                    NamedReceiverBench{"Tcp", make_tcp_bench, ""},
                    NamedReceiverBench{"Simulated", make_simulated_receiver_bench, ""},
                    NamedReceiverBench{"Replayed", make_replayed_receiver_bench, ""},
                    kernel_port()),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace plumbline::contract
