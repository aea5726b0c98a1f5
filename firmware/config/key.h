// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include "firmware/config/config.h"
#include "firmware/config/value.h"

namespace plumbline::config {

// One key of the file: the only place that knows its name, its meaning, its range and where its
// value lives. Its default is what get() finds in a fresh Config.
struct Key {
  std::string_view section;
  std::string_view name;
  std::string_view sentence;  // what it does, for the example
  std::string wants;          // "a number of seconds from 0 to 2": what may stand there
  std::function<Value(const Config&)> get;
  // False, with the Config as it was, where the value is not what the key wants.
  std::function<bool(Config&, const Value&)> put;
};

struct Section {
  std::string_view name;
  std::string_view sentence;
};

// In the order of the example.
const std::vector<Section>& sections();
const std::vector<Key>& keys();

// Null where there is none.
const Key* find_key(std::string_view section, std::string_view name);

}  // namespace plumbline::config
