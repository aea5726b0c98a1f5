// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "edge/base/gnss_fix.h"

namespace plumbline::gnss {

// "2026-11-20T10:00:00.20Z" and "T10:00:00.20Z" (ISO 8601): hundredths, or as many digits up to
// the microsecond as the time has.
std::string text_of(UtcTime time);
std::string text_of_day_time(std::chrono::microseconds since_midnight);

}  // namespace plumbline::gnss
