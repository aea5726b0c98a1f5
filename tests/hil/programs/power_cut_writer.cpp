// SPDX-License-Identifier: MIT
// power_cut_writer FOLDER [careless]: writes until power is cut, and says on its output, line by
// line, what would now survive: "log BYTES", "state NUMBER", "photo NUMBER". Careless, it leaves
// out every sync and says the same: what the bench must notice.
#include <cstdint>
#include <cstdio>
#include <string>

#include "drivers/posix/posix_storage.h"
#include "tests/hil/programs/promise.h"

namespace plumbline::hil {
namespace {

class Writer {
 public:
  Writer(Storage& storage, bool careless) : storage_(storage), careless_(careless) {}

  Status run() {
    auto log = storage_.create("log");
    if (!log) return log.error();
    if (const Status named = sync_root(); !named) return named;
    for (std::uint64_t number = 1;; ++number) {
      if (const Status done = step(**log, number); !done) return done;
    }
  }

 private:
  Status step(WritableFile& log, std::uint64_t number) {
    const std::string bytes = bytes_of(number);
    if (const Status done = log.append(bytes); !done) return done;
    if (const Status done = careless_ ? Status(Done{}) : log.sync(); !done) return done;
    logged_ += bytes.size();
    promise("log", logged_);
    if (number % 3 == 0) return put("state", "state", number);
    if (number % 3 == 1) return put("photo-" + std::to_string(number), "photo", number);
    return Done{};
  }

  Status put(const std::string& path, const char* kind, std::uint64_t number) {
    const Status done =
        careless_ ? write(path, bytes_of(number)) : publish(storage_, path, bytes_of(number));
    if (done) promise(kind, number);
    return done;
  }

  Status write(const std::string& path, const std::string& bytes) {
    auto file = storage_.create(path + ".new");
    if (!file) return file.error();
    if (const Status done = (*file)->append(bytes); !done) return done;
    return storage_.rename(path + ".new", path);
  }

  Status sync_root() { return careless_ ? Status(Done{}) : storage_.sync_folder(""); }

  static void promise(const char* kind, std::uint64_t figure) {
    std::printf("%s %llu\n", kind, static_cast<unsigned long long>(figure));
    std::fflush(stdout);
  }

  Storage& storage_;
  bool careless_;
  std::uint64_t logged_ = 0;
};

int run(const std::string& folder, bool careless) {
  const auto storage = posix::open_storage(folder);
  const Status ended = storage ? Writer(**storage, careless).run() : Status(storage.error());
  std::printf("power_cut_writer: %s\n", ended ? "ended" : ended.error().sentence.c_str());
  return 1;  // power should have been cut
}

}  // namespace
}  // namespace plumbline::hil

int main(int count, char** arguments) {
  if (count < 2) return 2;
  return plumbline::hil::run(arguments[1], count > 2);
}
