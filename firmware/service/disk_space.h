// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "drivers/storage.h"
#include "firmware/config/config.h"

namespace plumbline::service {

// How many more photos of the configured camera fit on the disk beside what is to stay free. Empty
// where the disk does not say.
std::optional<std::int64_t> photos_that_fit(Storage& storage, const config::Config& config);

// How many a flight as configured takes: heights and one side-step. Grid flights have no end.
std::int64_t photos_planned(const config::Config& config);

// Removes the files in FLIGHT/result of one flight after the other, the oldest first and never
// those of the newest two, until `is_enough`. Nothing else is touched. Returns how many results
// went.
int clean_results(Storage& storage, const std::function<bool()>& is_enough);

}  // namespace plumbline::service
