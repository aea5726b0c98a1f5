// SPDX-License-Identifier: MIT
#include "firmware/service/adviser.h"

#include <cmath>
#include <cstdio>

namespace plumbline::service {
namespace {

std::string centimetres(const std::optional<double>& sigma_m) {
  if (!sigma_m || !std::isfinite(*sigma_m)) return "unknown";
  char text[32];
  if (*sigma_m < 1) {
    std::snprintf(text, sizeof text, "%.1f cm", 100 * *sigma_m);
  } else {
    std::snprintf(text, sizeof text, "%.1f m", *sigma_m);
  }
  return text;
}

bool azimuth_unknown(const plan::Summary& summary) {
  for (const auto& quantity : summary.flight.unobservable) {
    if (quantity.name == "azimuth") return true;
  }
  return false;
}

}  // namespace

Advice advice_of(const plan::Summary& summary) {
  const std::string height = "Height " + centimetres(summary.worst.height_m);
  const std::string azimuth = azimuth_unknown(summary) ? ", azimuth unknown" : "";
  if (summary.goal_reached.value_or(false))
    return {height + azimuth + ": good, land.", height + ": good, land"};
  Advice advice{height + ", plan " + centimetres(summary.worst.plan_m) + azimuth, height + azimuth};
  const auto wanted = summary.cheapest ? summary.cheapest : summary.best;
  if (wanted) {
    const plan::Change& change = summary.advice[static_cast<std::size_t>(*wanted)].change;
    advice.sentence += ": " + change.what;
    if (change.aside_m > 0) {
      char text[32];
      std::snprintf(text, sizeof text, ": go %.0f m aside", change.aside_m);
      advice.short_text += text;
    }
  }
  advice.sentence += ".";
  return advice;
}

Adviser::Adviser(const plan::Options& options, Sink sink)
    : options_(options), sink_(std::move(sink)), thread_([this] { run(); }) {}

Adviser::~Adviser() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  changed_.notify_one();
  thread_.join();
}

void Adviser::decided(const capture::Decision& decision) {
  const std::lock_guard lock(mutex_);
  if (const auto* phase = std::get_if<capture::PhaseChanged>(&decision.what)) {
    if (phase->phase == capture::Phase::kFlying) taken_m_.clear();
    return;
  }
  const auto* taken = std::get_if<capture::PhotoTaken>(&decision.what);
  if (taken == nullptr || !taken->place) return;
  taken_m_.emplace_back(taken->place->in_enu_m.x(), taken->place->in_enu_m.y(),
                        taken->place->height_m);
  fixed_ = taken->place->quality == FixQuality::kFixed;
  asked_ = true;
  changed_.notify_one();
}

void Adviser::run() {
  for (;;) {
    plan::Flight flight;
    plan::Options options = options_;
    {
      std::unique_lock lock(mutex_);
      changed_.wait(lock, [this] { return asked_ || stopping_; });
      if (stopping_) return;
      asked_ = false;
      flight.taken_m = taken_m_;
      if (fixed_) options.rtk = plan::Rtk{};
    }
    if (flight.taken_m.size() < 2) continue;
    const auto summary = plan::plan(flight, options);
    {
      const std::lock_guard lock(mutex_);
      if (asked_) continue;  // another photo has come meanwhile
    }
    if (summary) sink_(advice_of(*summary));
  }
}

}  // namespace plumbline::service
