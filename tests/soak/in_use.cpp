// SPDX-License-Identifier: MIT
#include "tests/soak/in_use.h"

#include <malloc.h>

#include <atomic>
#include <cstdlib>
#include <filesystem>
#include <new>

// Counted here and not asked of the C library: mallinfo2() takes what it caches for what is used,
// and a sanitizer's allocator does not answer it.
namespace {

std::atomic<std::int64_t> blocks{0};
std::atomic<std::int64_t> bytes{0};

void* counted(void* block) {
  if (block == nullptr) std::abort();  // also where a null pointer would be taken for an answer
  ++blocks;
  bytes += static_cast<std::int64_t>(malloc_usable_size(block));
  return block;
}

void give_back(void* block) {
  if (block == nullptr) return;
  --blocks;
  bytes -= static_cast<std::int64_t>(malloc_usable_size(block));
  std::free(block);
}

}  // namespace

void* operator new(std::size_t size) { return counted(std::malloc(size == 0 ? 1 : size)); }
void* operator new(std::size_t size, std::align_val_t alignment) {
  const auto step = static_cast<std::size_t>(alignment);
  return counted(std::aligned_alloc(step, (size + step - 1) / step * step));
}
// As std::stable_sort asks for its buffer.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
  return counted(std::malloc(size == 0 ? 1 : size));
}
void operator delete(void* block) noexcept { give_back(block); }
void operator delete(void* block, const std::nothrow_t&) noexcept { give_back(block); }
void operator delete(void* block, std::size_t) noexcept { give_back(block); }
void operator delete(void* block, std::align_val_t) noexcept { give_back(block); }
void operator delete(void* block, std::size_t, std::align_val_t) noexcept { give_back(block); }

namespace plumbline::soak {

InUse in_use() {
  InUse now{blocks, bytes, 0};
  for ([[maybe_unused]] const auto& entry : std::filesystem::directory_iterator("/proc/self/fd"))
    ++now.descriptors;
  return now;
}

}  // namespace plumbline::soak
