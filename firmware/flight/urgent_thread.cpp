// SPDX-License-Identifier: MIT
#include "firmware/flight/urgent_thread.h"

#include <pthread.h>
#include <sched.h>

namespace plumbline::flight {
namespace {

constexpr int kPriority = 10;  // after the kernel's own interrupt threads, which have 50

bool set(int policy, int priority) {
  sched_param parameters{};
  parameters.sched_priority = priority;
  return ::pthread_setschedparam(::pthread_self(), policy, &parameters) == 0;
}

}  // namespace

UrgentThread::UrgentThread() {
  sched_param before{};
  if (::pthread_getschedparam(::pthread_self(), &policy_, &before) != 0) return;
  priority_ = before.sched_priority;
  is_allowed_ = set(SCHED_FIFO, kPriority);
}

UrgentThread::~UrgentThread() {
  if (is_allowed_) set(policy_, priority_);
}

}  // namespace plumbline::flight
