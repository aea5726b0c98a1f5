// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

#include "edge/capture/decisions.h"
#include "edge/capture/inputs.h"
#include "edge/record/packing.h"

namespace plumbline::record {

// The inputs and decisions of capture as bytes. The kind is kFirstInput or kFirstDecision plus the
// place in the variant: new cases go to its end.
inline constexpr std::uint16_t kFirstInput = 32;
inline constexpr std::uint16_t kFirstDecision = 64;

bool is_input(std::uint16_t kind);
bool is_decision(std::uint16_t kind);
std::uint16_t kind_of_input(const capture::Input& input);
std::uint16_t kind_of_decision(const capture::Decision& decision);

void pack_input(Packer& to, const capture::Input& input);
void pack_decision(Packer& to, const capture::Decision& decision);

capture::Input unpack_input(std::uint16_t kind, Unpacker& from);
capture::Decision unpack_decision(std::uint16_t kind, Unpacker& from);

}  // namespace plumbline::record
