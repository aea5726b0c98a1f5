// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "firmware/config/key.h"

// The table of keys in parts; keys() of key.h puts them together.

namespace plumbline::config {

std::vector<Key> device_keys();   // receiver, camera, release, pilot
std::vector<Key> capture_keys();  // capture, take_off, stillness
std::vector<Key> house_keys();    // recording, advice, measure, status

}  // namespace plumbline::config
