// SPDX-License-Identifier: MIT
#include "edge/base/parallel.h"

#include <algorithm>
#include <atomic>
#include <thread>
#include <vector>

namespace plumbline {

void parallel_for(int count, int threads, const std::function<void(int)>& work) {
  std::atomic<int> next{0};
  const auto drain = [&] {
    for (int i = next++; i < count; i = next++) work(i);
  };
  std::vector<std::thread> helpers;
  for (int t = 1; t < std::min(threads, count); ++t) helpers.emplace_back(drain);
  drain();
  for (std::thread& helper : helpers) helper.join();
}

}  // namespace plumbline
