// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drivers/byte_stream.h"
#include "edge/base/fix_decoder.h"
#include "edge/base/gnss_fix.h"

namespace plumbline::commands {

// How `plumbline gnss` writes to standard output: a table, or with `json` an object per line.

void print_fix(const GnssFix& fix, bool json);
void print_table_head();

// `reconnections`: of a live receiver.
void print_counters(const DecoderCounters& counters, std::optional<std::uint64_t> reconnections,
                    bool json);
void print_ports(const std::vector<SerialPortInfo>& ports, bool json);

std::string name_of(FixQuality quality);

// Of the east (0), north (1) or up (2) axis; empty where the receiver stated none.
std::optional<double> sigma_m(const GnssFix& fix, int axis);

}  // namespace plumbline::commands
