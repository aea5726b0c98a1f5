// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

namespace plumbline {

// Calls work(i) for i in [0, count) on `threads` threads (at least one). Each call writes only to
// its own slot, so that the result does not depend on the number of threads. Returns when all are
// done. `work` must not throw.
void parallel_for(int count, int threads, const std::function<void(int)>& work);

}  // namespace plumbline
