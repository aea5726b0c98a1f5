// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "edge/base/result.h"
#include "firmware/service/status/status_board.h"

namespace plumbline::service {

// Shows the board to whoever asks: a line of JSON on a local socket at once, after each change and
// once a second, and the same line in a file. A thread of its own; a client that does not read is
// dropped. At the end the last line is what the board says then.
class StatusServer {
 public:
  // A file that can no longer be written, and one that can again: once each, from its own thread.
  using FileEvent = std::function<void(bool good, const std::string& sentence)>;

  // `board` outlives it. An empty path: without that one. Fails where the socket cannot be made or
  // the file cannot be written.
  static Result<std::unique_ptr<StatusServer>> start(
      const StatusBoard& board, const std::string& socket_path, const std::string& file_path,
      FileEvent file_event = [](bool, const std::string&) {});
  ~StatusServer();

 private:
  StatusServer(const StatusBoard& board, int listener, std::string socket_path,
               std::string file_path, FileEvent file_event);
  void run();
  void show();
  void admit();

  const StatusBoard& board_;
  int listener_;
  std::string socket_path_;
  std::string file_path_;
  FileEvent file_event_;
  bool file_is_good_ = true;
  std::vector<int> clients_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace plumbline::service
