// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "firmware/service/advice/adviser.h"

namespace plumbline::service {
namespace {

constexpr std::size_t kPilotsLine = 50;  // characters of a MAVLink STATUSTEXT

template <typename... Arguments>
std::string worded(const char* format, Arguments... arguments) {
  char buffer[96];
  std::snprintf(buffer, sizeof buffer, format, arguments...);
  return buffer;
}

std::string centimetres(const std::optional<double>& sigma_m) {
  if (!sigma_m || !std::isfinite(*sigma_m)) return "unknown";
  return *sigma_m < 1 ? worded("%.1f cm", 100 * *sigma_m) : worded("%.1f m", *sigma_m);
}

bool is_unknown(const plan::Prediction& prediction, const char* quantity) {
  return std::any_of(prediction.unobservable.begin(), prediction.unobservable.end(),
                     [&](const auto& item) { return item.name == quantity; });
}

std::string azimuth_of(const plan::Prediction& prediction) {
  return is_unknown(prediction, "azimuth") ? ", azimuth unknown" : "";
}

std::string figures_of(const plan::Sigma& worst, const plan::Prediction& prediction) {
  return "height " + centimetres(worst.height_m) + ", plan " + centimetres(worst.plan_m) +
         azimuth_of(prediction);
}

std::string joined(std::string a, const std::string& b) {
  if (!a.empty() && !b.empty()) a += ", ";
  return a + b;
}

// What a pilot does about it, or whoever is on the ground, who cannot help this flight any more
// but by what is measured after it.
std::string action_of(const plan::Change& change) {
  std::string action;
  if (change.climb_m) action = worded("climb to %.0f m", *change.climb_m);
  if (change.from_m) action = worded("go down to %.0f m", *change.from_m);
  if (change.step_m) action = worded("photos every %.1f m", *change.step_m);
  if (change.aside_m > 0) {
    const char* format = change.across ? "fly an L of %.0f m" : "go %.0f m aside";
    action = joined(action, worded(format, change.aside_m));
  }
  if (change.heading_sigma_deg) {
    action = worded("needs a %.0f-degree compass", *change.heading_sigma_deg);
  }
  if (change.known_length_m) action = "needs a known length";
  if (change.control_points > 0) action = "needs a control point";
  return action;
}

double larger_of(const plan::Sigma& sigma) {
  constexpr double kInfinity = std::numeric_limits<double>::infinity();
  return std::max(sigma.plan_m.value_or(kInfinity), sigma.height_m.value_or(kInfinity));
}

// Where nothing reaches the goal: what a drone in the air can do, before what it cannot.
const plan::Advice* best_of(const plan::Summary& summary) {
  const plan::Advice* best = nullptr;
  double least = larger_of(summary.worst);
  for (const plan::Advice& advice : summary.advice) {
    if (advice.change.photos_m.empty() || larger_of(advice.worst) >= least) continue;
    least = larger_of(advice.worst);
    best = &advice;
  }
  if (best != nullptr || !summary.best) return best;
  return &summary.advice[static_cast<std::size_t>(*summary.best)];
}

const plan::Advice* wanted_of(const plan::Summary& summary) {
  if (!summary.cheapest) return best_of(summary);
  return &summary.advice[static_cast<std::size_t>(*summary.cheapest)];
}

// The first that fits.
std::string fitting(std::initializer_list<std::string> texts) {
  for (const std::string& text : texts) {
    if (text.size() <= kPilotsLine) return text;
  }
  return std::data(texts)[texts.size() - 1].substr(0, kPilotsLine);
}

std::string fixes_of(const Outlook& outlook) {
  if (outlook.without_fix == 0) return "";
  if (outlook.without_fix == outlook.photos) {
    return " Without a fixed position these are sigmas within the measured ground.";
  }
  return worded(" %d of %d photos have no fixed position.", outlook.without_fix, outlook.photos);
}

Advice at_the_end(const Outlook& outlook) {
  const plan::Summary& summary = outlook.flight;
  const std::string figures = "H" + figures_of(summary.worst, summary.flight).substr(1);
  const std::string height = "Height " + centimetres(summary.worst.height_m);
  if (summary.goal_reached.value_or(false))
    return {figures + ": good, land.", height + ": good, land"};
  const plan::Advice* wanted = wanted_of(summary);
  if (wanted == nullptr) {
    const std::string nothing = ": no change helps";
    return {figures + nothing + ".",
            fitting({height + azimuth_of(summary.flight) + nothing, height + nothing})};
  }
  const std::string action = ": " + action_of(wanted->change);
  return {figures + ": " + wanted->change.what + ".",
          fitting({height + azimuth_of(summary.flight) + action, height + action,
                   action_of(wanted->change)})};
}

Advice on_the_way(const Outlook& outlook) {
  const plan::Summary& summary = outlook.flight;
  plan::Sigma now;
  if (!outlook.now->rings.empty()) now = plan::worst_ring(*outlook.now);
  const std::string end = outlook.ends_at_top ? " at the top" : " at the end";
  Advice advice;
  advice.sentence = "So far " + figures_of(now, *outlook.now) + ";" + end + " " +
                    figures_of(summary.worst, summary.flight);
  if (summary.goal_reached.value_or(false)) {
    advice.sentence += ": good, go on.";
  } else if (const plan::Advice* wanted = wanted_of(summary)) {
    advice.sentence += ", and then: " + wanted->change.what + ".";
  } else {
    advice.sentence += ".";
  }
  advice.short_text = fitting({"So far height " + centimetres(now.height_m) + "; " +
                               centimetres(summary.worst.height_m) + end});
  return advice;
}

}  // namespace

Advice advice_of(const Outlook& outlook) {
  Advice advice = outlook.now ? on_the_way(outlook) : at_the_end(outlook);
  advice.sentence += fixes_of(outlook);
  return advice;
}

}  // namespace plumbline::service
