// SPDX-License-Identifier: MIT
#include "tests/contract/pilot_link_contract.h"

#include "tests/contract/pilot_benches.h"

namespace plumbline::contract {
namespace {

INSTANTIATE_TEST_SUITE_P(PilotLinks, PilotLinkContract,
                         testing::Values(PilotLinkMaker{"Pty", make_pty_pilot_bench},
                                         PilotLinkMaker{"UdpListening", make_listening_pilot_bench},
                                         PilotLinkMaker{"UdpSpeaking", make_speaking_pilot_bench},
                                         PilotLinkMaker{"Recording", make_recording_pilot_bench}),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace plumbline::contract
