// SPDX-License-Identifier: MIT
#pragma once

namespace plumbline::flight {

// While it lives, the thread that made it runs before all ordinary ones (SCHED_FIFO, sched(7)), and
// so do threads that it begins. Where the system does not allow that (RLIMIT_RTPRIO), nothing is
// different. Made and destroyed by one thread.
class UrgentThread {
 public:
  UrgentThread();
  ~UrgentThread();
  UrgentThread(const UrgentThread&) = delete;
  UrgentThread& operator=(const UrgentThread&) = delete;

  bool is_allowed() const { return is_allowed_; }

 private:
  int policy_ = 0;
  int priority_ = 0;
  bool is_allowed_ = false;
};

}  // namespace plumbline::flight
