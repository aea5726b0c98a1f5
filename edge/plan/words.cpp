// SPDX-License-Identifier: MIT
#include "edge/plan/words.h"

#include <cstdio>

#include "edge/base/index.h"

namespace plumbline::plan {
namespace {

template <typename... Arguments>
std::string text(const char* format, Arguments... arguments) {
  char buffer[256];
  std::snprintf(buffer, sizeof buffer, format, arguments...);
  return buffer;
}

std::string figures(const Sigma& worst, const std::optional<double>& azimuth_deg) {
  std::string out =
      "height " + length_in_words(worst.height_m) + ", plan " + length_in_words(worst.plan_m);
  out += azimuth_deg ? text(", azimuth %.2g degrees", *azimuth_deg) : ", azimuth unknown";
  return out;
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  for (char& c : out) c = c == '_' ? ' ' : c;
  return out;
}

std::string promise(const Advice& advice) {
  return advice.change.what + text(" (%.0f s more): ", advice.change.cost_s) +
         figures(advice.worst, advice.azimuth_deg);
}

// What a goal in metres says nothing of.
std::string remaining(const std::vector<std::string>& unobservable) {
  return unobservable.empty() ? "." : "; still not observable then: " + listed(unobservable) + ".";
}

std::vector<std::string> names_of(const std::vector<orient::Unobservable>& items) {
  std::vector<std::string> names;
  for (const auto& item : items) names.push_back(item.name);
  return names;
}

std::string without_goal(const Summary& summary) {
  const auto& unobservable = summary.flight.unobservable;
  if (!summary.cheapest) {
    return unobservable.empty() ? "Everything is observable."
                                : "No single change makes more of it observable; not observable: " +
                                      listed(names_of(unobservable)) + ".";
  }
  const Advice& advice = summary.advice[at(*summary.cheapest)];
  return "The cheapest change that leaves least unobservable: " + promise(advice) +
         (advice.unobservable.empty() ? "; everything is observable then."
                                      : remaining(advice.unobservable));
}

std::string reached(const Summary& summary, const std::string& goal) {
  const std::string out = "The goal of " + goal + " is reached; nothing to change";
  const auto& unobservable = summary.flight.unobservable;
  if (unobservable.empty()) return out + ".";
  return out + " for it. Not observable all the same: " + listed(names_of(unobservable)) + ".";
}

std::string with_goal(const Summary& summary, double goal_m) {
  const std::string goal = length_in_words(goal_m);
  if (*summary.goal_reached) return reached(summary, goal);
  const auto chosen = summary.cheapest ? summary.cheapest : summary.best;
  if (!chosen) return "Nothing tried reaches the goal of " + goal + ", or comes nearer to it.";
  const Advice& advice = summary.advice[at(*chosen)];
  return (summary.cheapest ? "The cheapest change that reaches the goal of " + goal + ": "
                           : "Nothing tried reaches the goal of " + goal + "; the best: ") +
         promise(advice) + remaining(advice.unobservable);
}

}  // namespace

std::string length_in_words(std::optional<double> metres) {
  if (!metres) return "unknown";
  if (*metres < 0.000995) return text("%.2g mm", 1000 * *metres);
  if (*metres < 0.00995) return text("%.1f mm", 1000 * *metres);
  if (*metres < 0.995) return text("%.1f cm", 100 * *metres);
  return text(*metres < 9.95 ? "%.2f m" : "%.0f m", *metres);
}

std::string sentence_of(const Summary& summary, const Options& options) {
  std::string out = figures(summary.worst, summary.flight.azimuth_deg);
  out[0] = 'H';
  out += text(" (sigma, %s, worst ring within %.6g m). ",
              summary.flight.georeferenced ? "absolute" : "local", summary.radius_m);
  return out + (options.goal_m ? with_goal(summary, *options.goal_m) : without_goal(summary));
}

}  // namespace plumbline::plan
