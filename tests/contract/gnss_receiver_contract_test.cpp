// SPDX-License-Identifier: MIT
#include "tests/contract/gnss_receiver_contract.h"

#include "tests/contract/kernel_receiver_bench.h"
#include "tests/contract/real_receiver_benches.h"
#include "tests/contract/virtual_receiver_benches.h"

namespace plumbline::contract {
namespace {

INSTANTIATE_TEST_SUITE_P(
    Receivers, GnssReceiverContract,
    testing::Values(NamedReceiverBench{"Pty", make_pty_bench},
                    NamedReceiverBench{"Tcp", make_tcp_bench},
                    NamedReceiverBench{"OfThisMachine", make_kernel_receiver_bench},
                    NamedReceiverBench{"Simulated", make_simulated_receiver_bench},
                    NamedReceiverBench{"Replayed", make_replayed_receiver_bench}),
    [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace plumbline::contract
