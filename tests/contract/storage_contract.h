// SPDX-License-Identifier: MIT
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <functional>
#include <memory>
#include <ostream>
#include <string>

#include "drivers/storage.h"

namespace plumbline::contract {

// An empty disk, and the means to be unkind to it.
class StorageBench {
 public:
  virtual ~StorageBench() = default;
  virtual Storage& storage() = 0;
  // No file may grow beyond this (of a real disk) or all files together (of a simulated one).
  virtual void allow_bytes(std::uint64_t bytes) = 0;
  virtual void allow_all() = 0;
};

struct StorageMaker {
  std::string name;
  std::function<std::unique_ptr<StorageBench>()> make;
};
inline void PrintTo(const StorageMaker& maker, std::ostream* out) { *out << maker.name; }

// What drivers/storage.h promises, but for what only a power cut shows.
class StorageContract : public ::testing::TestWithParam<StorageMaker> {
 protected:
  std::unique_ptr<StorageBench> bench_ = GetParam().make();
  Storage& storage_ = bench_->storage();
};

}  // namespace plumbline::contract
