// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <vector>

#include "edge/base/gnss_fix.h"

namespace plumbline::gnss {

// Whether the times are those of exposures (a receiver's time marks) rather than epochs of a
// running receiver. Epochs come on a grid, faster than once in `slowest_epochs`; marks come when
// the camera fires. Fewer than two times are marks.
bool looks_like_time_marks(
    const std::vector<GnssFix>& fixes,
    std::chrono::microseconds slowest_epochs = std::chrono::milliseconds(1050));

enum class DateState { kKnown, kCompleted, kUnknown };

// Gives every fix with a time of day its date, where any fix has one: backwards from the first
// dated, over midnight too. Where none has, dates are counted from 1970-01-01 and kUnknown is
// returned: only the times of day are true.
DateState complete_dates(std::vector<GnssFix>& fixes);

}  // namespace plumbline::gnss
