// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "edge/base/result.h"

namespace plumbline::sim {

// A serial port without hardware: a pseudo-terminal, reached under a path of one's own (a symbolic
// link to its slave), that can be pulled out and plugged in again under the same path. Whoever has
// it open when it is pulled sees what a pulled USB cable shows: a hang-up, and nothing to read.
// The one part of sim that asks the system for anything.
class PtyPort {
 public:
  // Pulled out until plug_in(). `path` must not exist.
  explicit PtyPort(std::string path) : path_(std::move(path)) {}
  PtyPort(const PtyPort&) = delete;
  PtyPort& operator=(const PtyPort&) = delete;
  ~PtyPort() { pull(); }

  // Fails, in a sentence, where the system has no pseudo-terminals or the path cannot be made.
  Status plug_in();
  void pull();

  // What the receiver sends. Bytes that nobody takes are lost, as on a line; none wait.
  void send(std::string_view bytes);

  // What was written to the port since the last call.
  std::string received();

  const std::string& path() const { return path_; }

 private:
  std::string path_;
  int master_ = -1;
};

}  // namespace plumbline::sim
