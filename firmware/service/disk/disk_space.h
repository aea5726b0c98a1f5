// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>

#include "drivers/storage.h"
#include "firmware/config/config.h"

namespace plumbline::service {

// The size of the photos: as configured, else as the rows of the camera's frames tell, else usual.
struct PhotoSize {
  int width_px = 0;
  int height_px = 0;
};
PhotoSize photo_size(const CameraOptions& options, std::optional<int> rows_seen = {});

// How many more photos of that size fit on the disk beside what is to stay free. Empty where the
// disk does not say.
std::optional<std::int64_t> photos_that_fit(Storage& storage, const PhotoSize& photo,
                                            double keep_free_mb);

// How many a flight as configured takes: heights and one side-step; where photos are taken by time
// or distance, those of half an hour at 5 metres per second besides.
std::int64_t photos_planned(const capture::CapturePlan& plan);

// Removes the files in FLIGHT/result of one flight after the other, the oldest first and never
// those of the newest two, until `is_enough`. Nothing else is touched. Returns how many results
// went.
int clean_results(Storage& storage, const std::function<bool()>& is_enough);

}  // namespace plumbline::service
