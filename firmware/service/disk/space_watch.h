// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>

#include "drivers/storage.h"
#include "firmware/config/config.h"

namespace plumbline::service {

// Keeps an eye on the room for the photos of a flight as configured, and makes some where it may:
// recording.clean_results. One thread.
class SpaceWatch {
 public:
  struct Events {
    std::function<void(std::int64_t free_photos, std::int64_t planned)> found;  // at each look
    std::function<void(const std::string& sentence)> told;                      // of a change
    std::function<void(const std::string& short_text)> lacks;  // for the pilot, when it begins
  };

  // `config` and `storage` outlive it.
  SpaceWatch(const config::Config& config, Storage& storage, Events events);

  // The photos are as large as configured, else as frames of so many rows tell. Says nothing of a
  // disk that does not tell its room.
  void look(std::optional<int> rows_seen);

  // A lack that was told is told again at the next look.
  void tell_anew() { lack_is_told_ = false; }

 private:
  std::optional<std::int64_t> free_photos(std::optional<int> rows_seen) const;
  bool is_enough(std::optional<std::int64_t> photos) const;

  const config::Config& config_;
  Storage& storage_;
  Events events_;
  std::int64_t planned_;
  bool lack_is_told_ = false;
};

}  // namespace plumbline::service
