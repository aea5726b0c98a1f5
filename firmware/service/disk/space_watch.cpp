// SPDX-License-Identifier: MIT
#include "firmware/service/disk/space_watch.h"

#include <utility>

#include "firmware/service/disk/disk_space.h"

namespace plumbline::service {

SpaceWatch::SpaceWatch(const config::Config& config, Storage& storage, Events events)
    : config_(config),
      storage_(storage),
      events_(std::move(events)),
      planned_(photos_planned(config.capture.plan)) {}

std::optional<std::int64_t> SpaceWatch::free_photos(std::optional<int> rows_seen) const {
  return photos_that_fit(storage_, photo_size(config_.camera.options, rows_seen),
                         config_.recording.keep_free_mb);
}

bool SpaceWatch::is_enough(std::optional<std::int64_t> photos) const {
  return photos.value_or(planned_) >= planned_;
}

void SpaceWatch::look(std::optional<int> rows_seen) {
  auto photos = free_photos(rows_seen);
  if (!is_enough(photos) && !lack_is_told_ && config_.recording.clean_results) {
    const int cleaned = clean_results(storage_, [&] { return is_enough(free_photos(rows_seen)); });
    if (cleaned > 0) {
      events_.told("The results of " + std::to_string(cleaned) + " old flights made room.");
    }
    photos = free_photos(rows_seen);
  }
  if (!photos) return;
  events_.found(*photos, planned_);
  const bool lacks = !is_enough(photos);
  if (std::exchange(lack_is_told_, lacks) == lacks) return;
  const std::string room = std::to_string(*photos) + " of " + std::to_string(planned_) + " photos";
  events_.told("disk: There is room for " + room + (lacks ? "." : " again."));
  if (lacks) events_.lacks("Disk: room for " + room);
}

}  // namespace plumbline::service
