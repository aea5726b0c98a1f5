// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "edge/base/result.h"
#include "firmware/service/status_board.h"

namespace plumbline::service {

// Shows the board to whoever asks: a line of JSON on a local socket at once and after each change,
// and the same line in a file. A thread of its own; a client that does not read is dropped.
class StatusServer {
 public:
  // `board` outlives it. An empty path: without that one. Fails where the socket cannot be made.
  static Result<std::unique_ptr<StatusServer>> start(const StatusBoard& board,
                                                     const std::string& socket_path,
                                                     const std::string& file_path);
  ~StatusServer();

 private:
  StatusServer(const StatusBoard& board, int listener, std::string socket_path,
               std::string file_path);
  void run();
  void admit(const std::string& line);
  void tell(const std::string& line);
  void write_file(const std::string& line) const;

  const StatusBoard& board_;
  int listener_;
  std::string socket_path_;
  std::string file_path_;
  std::vector<int> clients_;
  std::atomic<bool> stopping_ = false;
  std::thread thread_;
};

}  // namespace plumbline::service
