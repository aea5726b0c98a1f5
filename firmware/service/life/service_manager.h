// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/base/result.h"

namespace plumbline::service {

// What started this program as a service, where that is systemd (or anything that speaks its
// protocol: sd_notify(3)). Where NOTIFY_SOCKET is not set nobody listens, and every member does
// nothing. Any thread; none waits for an answer. Fails where the socket takes nothing.
class ServiceManager {
 public:
  bool is_there() const;
  Status ready(const std::string& sentence) const;  // up, and what it does
  Status show(const std::string& sentence) const;   // what it does now
  Status lives() const;  // since the last time; where that stays out, it is started anew
  Status stopping() const;
};

}  // namespace plumbline::service
