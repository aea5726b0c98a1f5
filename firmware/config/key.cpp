// SPDX-License-Identifier: MIT
#include "firmware/config/key.h"

#include <algorithm>

#include "firmware/config/section_keys.h"

namespace plumbline::config {

const std::vector<Section>& sections() {
  static const std::vector<Section> all = {
      {"receiver", "The GNSS receiver."},
      {"camera", "The camera. Mode, focus and crop stay as they are through a flight."},
      {"release", "How a photo is taken."},
      {"pilot", "The autopilot."},
      {"capture", "Where photos are taken. Heights are above the take-off point."},
      {"take_off", "When a flight begins and ends."},
      {"stillness", "A pilot who pauses at a height gets its photo when the drone is at rest."},
      {"recording", "The disk."},
      {"advice", "Advice in the air."},
      {"measure", "Measuring, in a process of its own."},
      {"status", "What the daemon says of itself."},
  };
  return all;
}

const std::vector<Key>& keys() {
  static const std::vector<Key> all = [] {
    std::vector<Key> keys = device_keys();
    for (const auto& part : {capture_keys(), house_keys()}) {
      keys.insert(keys.end(), part.begin(), part.end());
    }
    return keys;
  }();
  return all;
}

const Key* find_key(std::string_view section, std::string_view name) {
  const auto found = std::ranges::find_if(
      keys(), [&](const Key& key) { return key.section == section && key.name == name; });
  return found == keys().end() ? nullptr : &*found;
}

}  // namespace plumbline::config
