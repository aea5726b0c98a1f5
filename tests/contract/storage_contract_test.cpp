// SPDX-License-Identifier: MIT
#include "tests/contract/storage_contract.h"

#include <sys/resource.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <thread>

#include "drivers/posix/posix_storage.h"
#include "sim/sim_disk.h"

namespace plumbline::contract {
namespace {

// A folder of its own, gone with the test.
class TemporaryFolder {
 public:
  TemporaryFolder() {
    std::string pattern =
        (std::filesystem::temp_directory_path() / "plumbline-storage-XXXXXX").string();
    path_ = ::mkdtemp(pattern.data()) != nullptr ? pattern : "";
  }
  ~TemporaryFolder() { std::filesystem::remove_all(path_); }
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

class PosixBench : public StorageBench {
 public:
  ~PosixBench() override { allow_all(); }
  Storage& storage() override { return *storage_.value(); }
  void allow_bytes(std::uint64_t bytes) override { limit(bytes); }
  void allow_all() override { limit(before_.rlim_cur); }

 private:
  void limit(rlim_t bytes) const {
    const rlimit limit{bytes, before_.rlim_max};
    ::setrlimit(RLIMIT_FSIZE, &limit);
  }
  static rlimit limit_now() {
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    return limit;
  }

  TemporaryFolder folder_;
  rlimit before_ = limit_now();
  Result<std::unique_ptr<Storage>> storage_ = posix::open_storage(folder_.path());
};

class SimBench : public StorageBench {
 public:
  Storage& storage() override { return disk_; }
  void allow_bytes(std::uint64_t bytes) override { disk_.set_capacity(bytes); }
  void allow_all() override { disk_.set_capacity(1'000'000'000); }

 protected:
  sim::SimDisk disk_;
};

// What a worn card does, which no promise may rest on.
class SlowSimBench : public SimBench {
 public:
  SlowSimBench() {
    disk_.slow_down(std::chrono::milliseconds(20),
                    [](auto time) { std::this_thread::sleep_for(time); });
  }
};

template <typename Bench>
StorageMaker maker(const std::string& name) {
  return {name, [] { return std::make_unique<Bench>(); }};
}

INSTANTIATE_TEST_SUITE_P(AllStorages, StorageContract,
                         ::testing::Values(maker<PosixBench>("Posix"), maker<SimBench>("Simulated"),
                                           maker<SlowSimBench>("SimulatedSlow")),
                         [](const auto& info) { return info.param.name; });

}  // namespace
}  // namespace plumbline::contract
