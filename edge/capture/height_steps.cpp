// SPDX-License-Identifier: MIT
#include "edge/capture/height_steps.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace plumbline::capture {
namespace {

constexpr double kGoneBy_m = 0.3;  // so far beyond a height it is missed
constexpr double kWasAbove_m = 1;  // and so far above it a way down begins
constexpr double kLonely_m = 5;    // the gap about a height that is the only one

}  // namespace

HeightSteps::HeightSteps(const CapturePlan& plan) {
  if (plan.direction != Direction::kDown) {
    for (const double height_m : plan.heights_m) entries_.push_back({height_m, 1, true});
  }
  if (plan.direction != Direction::kUp) {
    for (const double height_m : plan.heights_m) entries_.push_back({height_m, -1, false});
  }
}

void HeightSteps::look(double height_m) {
  for (Entry& entry : entries_) {
    if (entry.sign < 0 && height_m > entry.height_m + kWasAbove_m) entry.open = true;
    if (!entry.open || entry.taken) continue;
    if (entry.sign * (height_m - entry.height_m) > 0) entry.passed = true;
  }
}

bool HeightSteps::is_wanted(const Entry& entry, int sign) const {
  return entry.open && !entry.taken && (entry.passed || entry.sign == sign);
}

int HeightSteps::first_between(double from_m, double to_m) const {
  const int sign = to_m > from_m ? 1 : -1;
  int first = -1;
  double least_m = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const double ahead_m = sign * (entries_[k].height_m - from_m);
    if (ahead_m <= 0 || ahead_m > sign * (to_m - from_m) || ahead_m >= least_m) continue;
    if (!is_wanted(entries_[k], sign)) continue;
    least_m = ahead_m;
    first = static_cast<int>(k);
  }
  return first;
}

double HeightSteps::half_gap_m(std::size_t entry) const {
  double gap_m = std::numeric_limits<double>::max();
  for (const Entry& other : entries_) {
    const double distance_m = std::abs(other.height_m - entries_[entry].height_m);
    if (distance_m > 0) gap_m = std::min(gap_m, distance_m);
  }
  return gap_m < std::numeric_limits<double>::max() ? gap_m / 2 : kLonely_m / 2;
}

int HeightSteps::passed_at(double height_m) const {
  int nearest = -1;
  double least_m = std::numeric_limits<double>::max();
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const Entry& entry = entries_[k];
    const double off_m = std::abs(height_m - entry.height_m);
    if (!entry.passed || entry.taken || off_m > half_gap_m(k) || off_m >= least_m) continue;
    least_m = off_m;
    nearest = static_cast<int>(k);
  }
  return nearest;
}

int HeightSteps::near(double height_m, double distance_m) const {
  int nearest = -1;
  double least_m = distance_m;
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    const double off_m = std::abs(height_m - entries_[k].height_m);
    if (!entries_[k].open || entries_[k].taken || off_m > least_m) continue;
    least_m = off_m;
    nearest = static_cast<int>(k);
  }
  return nearest;
}

int HeightSteps::left_behind(double height_m, int aimed_at) {
  for (std::size_t k = 0; k < entries_.size(); ++k) {
    Entry& entry = entries_[k];
    if (!entry.passed || entry.taken || entry.told || static_cast<int>(k) == aimed_at) continue;
    if (std::abs(height_m - entry.height_m) <= half_gap_m(k)) continue;
    entry.told = true;
    return static_cast<int>(k);
  }
  return -1;
}

bool HeightSteps::is_late(int entry, double height_m) const {
  const Entry& it = entries_[static_cast<std::size_t>(entry)];
  return it.passed && std::abs(height_m - it.height_m) > kGoneBy_m;
}

void HeightSteps::set_taken(int entry, bool taken) {
  if (entry >= 0) entries_[static_cast<std::size_t>(entry)].taken = taken;
}

std::vector<std::uint8_t> HeightSteps::taken() const {
  std::vector<std::uint8_t> taken;
  for (const Entry& entry : entries_) taken.push_back(entry.taken ? 1 : 0);
  return taken;
}

void HeightSteps::resume(const std::vector<std::uint8_t>& taken) {
  for (std::size_t k = 0; k < std::min(taken.size(), entries_.size()); ++k) {
    entries_[k].taken = taken[k] != 0;
    entries_[k].open = true;
  }
}

bool HeightSteps::any_taken() const {
  return std::any_of(entries_.begin(), entries_.end(), [](const Entry& e) { return e.taken; });
}

double HeightSteps::lowest_m() const {
  double lowest_m = 0;
  for (const Entry& entry : entries_) {
    if (lowest_m == 0 || entry.height_m < lowest_m) lowest_m = entry.height_m;
  }
  return lowest_m;
}

}  // namespace plumbline::capture
