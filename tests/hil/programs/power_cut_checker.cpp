// SPDX-License-Identifier: MIT
// power_cut_checker FOLDER PROMISES: after a power cut, whether all is there and whole that
// power_cut_writer had promised, and nothing published is torn. Prints what is not, and a summary.
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <fstream>
#include <string>
#include <vector>

#include "drivers/posix/posix_storage.h"
#include "tests/hil/programs/promise.h"

namespace plumbline::hil {
namespace {

struct Promises {
  std::uint64_t log_bytes = 0;
  std::uint64_t state = 0;
  std::vector<std::uint64_t> photos;
};

Promises read_promises(const std::string& path) {
  Promises promises;
  std::ifstream lines(path);
  std::string kind;
  for (std::uint64_t figure = 0; lines >> kind >> figure;) {
    if (kind == "log") promises.log_bytes = figure;
    if (kind == "state") promises.state = figure;
    if (kind == "photo") promises.photos.push_back(figure);
  }
  return promises;
}

class Checker {
 public:
  explicit Checker(Storage& storage) : storage_(storage) {}

  void check(const Promises& promises) {
    check_log(promises.log_bytes);
    const std::uint64_t state = promises.state == 0 ? 0 : number_of("state");
    if (state < promises.state) broken("state", "is older than promised, or torn");
    for (const std::uint64_t photo : promises.photos) {
      if (number_of("photo-" + std::to_string(photo)) != photo) {
        broken("photo-" + std::to_string(photo), "was promised and is not there, or torn");
      }
    }
    check_all_published();
    std::printf("promised: %llu bytes of log, state %llu, %zu photos; broken: %d\n",
                static_cast<unsigned long long>(promises.log_bytes),
                static_cast<unsigned long long>(promises.state), promises.photos.size(), broken_);
  }

  int broken() const { return broken_; }

 private:
  void check_log(std::uint64_t promised) {
    const auto log = storage_.read("log");
    const std::string found = log ? *log : "";
    std::string meant;
    for (std::uint64_t number = 1; meant.size() < promised; ++number) meant += bytes_of(number);
    if (found.size() < promised) return broken("log", "is shorter than promised");
    if (found.compare(0, promised, meant, 0, promised) != 0) broken("log", "holds other bytes");
  }

  // Promised or not: what has its name must be whole.
  void check_all_published() {
    const auto names = storage_.list("");
    if (!names) return broken("folder", "cannot be listed");
    for (const std::string& name : *names) {
      const bool published = name.starts_with("photo-") && !name.ends_with(".part");
      if (published && number_of(name) == 0) broken(name, "is torn");
    }
  }

  std::uint64_t number_of(const std::string& path) {
    const auto bytes = storage_.read(path);
    return bytes ? number_in(*bytes) : 0;
  }

  void broken(const std::string& what, const char* how) {
    ++broken_;
    std::printf("%s %s\n", what.c_str(), how);
  }

  Storage& storage_;
  int broken_ = 0;
};

int run(const std::string& folder, const std::string& promises) {
  const auto storage = posix::open_storage(folder);
  if (!storage) {
    std::printf("power_cut_checker: %s\n", storage.error().sentence.c_str());
    return 1;
  }
  Checker checker(**storage);
  checker.check(read_promises(promises));
  return checker.broken() == 0 ? 0 : 3;
}

}  // namespace
}  // namespace plumbline::hil

int main(int count, char** arguments) {
  return count == 3 ? plumbline::hil::run(arguments[1], arguments[2]) : 2;
}
