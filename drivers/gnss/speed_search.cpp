// SPDX-License-Identifier: MIT
#include "drivers/gnss/speed_search.h"

namespace plumbline::gnss_driver {
namespace {

using std::chrono::milliseconds;

constexpr std::size_t kPlentyOfBytes = 400;  // a few sentences
constexpr milliseconds kForPlenty{250};
constexpr milliseconds kForAny{1300};  // receivers send at least once a second
constexpr milliseconds kForProved{3000};

}  // namespace

void SpeedSearch::begin(HostTime now) {
  since_ = now;
  bytes_ = 0;
}

void SpeedSearch::sentence_came(HostTime now) {
  proved_ = true;
  begin(now);
}

std::optional<int> SpeedSearch::next(HostTime now) {
  if (speeds_.size() < 2 || !is_wrong(now)) return std::nullopt;
  proved_ = false;
  at_ = (at_ + 1) % speeds_.size();
  begin(now);
  return speeds_[at_];
}

bool SpeedSearch::is_wrong(HostTime now) const {
  const auto tried = now - since_;
  if (proved_) return bytes_ >= kPlentyOfBytes && tried >= kForProved;
  return (bytes_ >= kPlentyOfBytes && tried >= kForPlenty) || (bytes_ > 0 && tried >= kForAny);
}

}  // namespace plumbline::gnss_driver
