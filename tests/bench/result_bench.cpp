// SPDX-License-Identifier: MIT
// How long after the last photo the result of all photos is on the disk: a simulated climb of 30 to
// 90 m with a side-step, in real time with pictures, through the real daemon and its measuring
// process. Says where the time went, and fails where it is more than 10 s. Takes two minutes and a
// half, and both cores to itself.
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>

#include "tests/firmware/daemon/benched_daemon.h"

namespace plumbline::acceptance {
namespace {

constexpr double kMost_s = 10;
constexpr int kPatience_s = 300;

// Of the last run of the measuring process.
void tell_stages(const fs::path& result) {
  const auto timing = Json::parse(text_of(result / "timing.json"), nullptr, false);
  if (!timing.is_object() || !timing.contains("stages_s")) return;
  for (const auto& [stage, seconds] : timing["stages_s"].items()) {
    std::printf("  %-16s %5.1f s\n", stage.c_str(), seconds.get<double>());
  }
}

int wait_and_judge(const fs::path& folder) {
  const BenchedDaemon daemon(folder);
  const Json status = daemon.wait_for_result(kPatience_s);
  std::size_t photos = 0;
  fs::file_time_type last = fs::file_time_type::min();
  std::error_code none;
  for (const auto& file : fs::directory_iterator(daemon.flight() / "photos", none)) {
    last = std::max(last, file.last_write_time());
    ++photos;
  }
  if (photos == 0 || !says_all_measured(status, photos)) {
    std::printf("no result of all %zu photos within %d s:\n%s", photos, kPatience_s,
                daemon.log().c_str());
    return 1;
  }
  const fs::path result = daemon.flight() / "result";
  const auto after = fs::last_write_time(result / "timing.json") - last;
  const double after_s = std::chrono::duration<double>(after).count();
  std::printf("%zu photos; the result of all was there %.1f s after the last one (at most %g)\n",
              photos, after_s, kMost_s);
  tell_stages(result);
  return after_s <= kMost_s ? 0 : 1;
}

int run() {
  std::string pattern = (fs::temp_directory_path() / "plumbline-result-XXXXXX").string();
  const fs::path folder = ::mkdtemp(pattern.data());
  const int status = wait_and_judge(folder);
  fs::remove_all(folder);
  return status;
}

}  // namespace
}  // namespace plumbline::acceptance

int main() { return plumbline::acceptance::run(); }
