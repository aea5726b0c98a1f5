// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <memory>
#include <optional>

#include "drivers/clock.h"
#include "drivers/gpio/gpio_lines.h"
#include "drivers/trigger_line.h"

namespace plumbline::gpio {

struct TriggerLineOptions {
  std::optional<LineSettings> out;
  std::optional<LineSettings> in;
  std::chrono::microseconds pulse_width = std::chrono::milliseconds(20);
};

// A trigger line on GPIO character devices. Fails where a line that is asked for is not there or
// is held by another. `clock` outlives it.
Result<std::unique_ptr<TriggerLine>> make_trigger_line(const TriggerLineOptions& options,
                                                       const Clock& clock);

}  // namespace plumbline::gpio
