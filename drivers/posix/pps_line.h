// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <optional>
#include <string>

#include "drivers/clock.h"
#include "drivers/posix/pps_source.h"
#include "drivers/trigger_line.h"

namespace plumbline::posix {

// When a pulse that the kernel stamped by the wall clock began, by the readings of both clocks
// before and after it. Empty where the wall clock was set in between, or slewed by more than the
// 500 ppm that adjtimex(2) allows, or where the stamp does not lie between the readings.
std::optional<HostTime> host_time_of(WallTime stamp, const WallReading& before,
                                     const WallReading& after);

// Pulses per second of a PPS device as rising edges of an input line; it has no output. A pulse
// whose time cannot be told, because the wall clock was being set, is among the EdgesLost before
// the next. A GPIO line, where there is one, is better: its stamps need no conversion. `clock`
// outlives it.
std::unique_ptr<TriggerLine> make_pps_line(std::unique_ptr<PpsSource> source, const Clock& clock);
Result<std::unique_ptr<TriggerLine>> open_pps_line(const std::string& path, const Clock& clock);

}  // namespace plumbline::posix
