// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "tests/hil/host/line_socket.h"

namespace plumbline::hil {

// A root shell in the guest (guest/system/, "orders"). One thread.
class GuestShell {
 public:
  struct Answer {
    int status = 0;  // of the command
    std::string output;
  };

  // Waits for the guest to come up. False where it does not.
  bool open(const std::string& socket, std::chrono::seconds at_most);

  // Empty where the guest did not answer in time.
  std::optional<Answer> run(const std::string& command, std::chrono::seconds at_most);

 private:
  LineSocket lines_;
};

// The hand at the cables: QEMU's machine protocol. One thread.
class Cables {
 public:
  bool open(const std::string& socket);

  // The device named `id`; done when it is gone.
  bool pull(const std::string& id);

  // `device`: the members of QEMU's device_add, as JSON.
  bool plug(const std::string& device);

 private:
  bool ask(const std::string& request, const std::string& until);

  LineSocket lines_;
};

}  // namespace plumbline::hil
