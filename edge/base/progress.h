// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

namespace plumbline {

// Told by long work where it stands: the stage in words, `done` of `total` steps of that stage.
// Called from one thread at a time.
using Progress = std::function<void(const std::string& stage, int done, int total)>;

}  // namespace plumbline
