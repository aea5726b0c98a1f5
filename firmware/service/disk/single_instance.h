// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/base/result.h"

namespace plumbline::service {

// One daemon for one folder of flights: a lock that goes with the process, however it ends.
class SingleInstance {
 public:
  // Fails where another holds it, or the folder cannot be written.
  static Result<SingleInstance> in(const std::string& folder);
  ~SingleInstance();
  SingleInstance(SingleInstance&& other) noexcept;
  SingleInstance& operator=(SingleInstance&&) = delete;

 private:
  explicit SingleInstance(int descriptor) : descriptor_(descriptor) {}
  int descriptor_;
};

}  // namespace plumbline::service
