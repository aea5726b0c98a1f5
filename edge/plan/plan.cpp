// SPDX-License-Identifier: MIT
#include "edge/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "edge/base/index.h"
#include "edge/plan/model.h"
#include "edge/plan/words.h"

namespace plumbline::plan {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double larger(const Sigma& sigma) {
  return std::max(sigma.plan_m.value_or(kInfinity), sigma.height_m.value_or(kInfinity));
}

std::vector<std::string> names(const std::vector<orient::Unobservable>& items) {
  std::vector<std::string> out;
  for (const auto& item : items) out.push_back(item.name);
  return out;
}

class Planner {
 public:
  Planner(const Flight& flight, const Options& options) : flight_(flight), options_(options) {}

  Result<Summary> make() {
    if (auto status = check(flight_, options_); !status) return status.error();
    // The ground that matters stays the same, whatever changes.
    flight_.foot_m = foot_of(flight_);
    out_.radius_m = rings_of(flight_, options_).back().to_m;
    options_.radius_m = out_.radius_m;
    auto prediction = predict(flight_, options_, Detail::kAll);
    if (!prediction) return prediction.error();
    out_.flight = std::move(*prediction);
    out_.worst = worst_ring(out_.flight);
    out_.duration_s = duration_s(flight_, options_.costs);
    if (options_.goal_m) out_.goal_reached = larger(out_.worst) <= *options_.goal_m;
    fill_standard_accuracy();
    search();
    out_.sentence = sentence_of(out_, options_);
    return std::move(out_);
  }

 private:
  void fill_standard_accuracy() {
    const std::vector<Eigen::Vector3d> places = flight_.all_m();
    for (const auto& place : places) {
      out_.mean_height_m += place.z() / static_cast<double>(places.size());
    }
    out_.base_m = highest_m(flight_) - lowest_m(flight_);
    if (!(out_.base_m > 0)) return;
    out_.standard_accuracy = geometry::standard_accuracy(
        out_.mean_height_m, out_.base_m, options_.camera.interior[0], options_.sigma_px);
  }

  // Empty where the changed flight cannot be computed.
  std::optional<Advice> advice_on(const Change& change, Detail detail) const {
    const auto prediction = predict(changed(flight_, change), changed(options_, change), detail);
    if (!prediction) return std::nullopt;
    Advice advice{change, worst_ring(*prediction), prediction->azimuth_deg,
                  names(prediction->unobservable), false};
    if (options_.goal_m) advice.reaches_goal = larger(advice.worst) <= *options_.goal_m;
    return advice;
  }

  void look_at(const std::vector<Change>& changes) {
    for (const Change& change : changes) {
      if (auto advice = advice_on(change, Detail::kRepresentative)) {
        out_.advice.push_back(std::move(*advice));
      }
    }
  }

  bool any_reaches() const {
    return std::any_of(out_.advice.begin(), out_.advice.end(),
                       [](const Advice& advice) { return advice.reaches_goal; });
  }

  void search() {
    const std::vector<Change> singles = single_changes(flight_, options_);
    look_at(singles);
    if (!options_.goal_m) return choose_without_goal();
    if (!*out_.goal_reached && !any_reaches()) {
      look_at(paired_changes(singles));
      std::stable_sort(out_.advice.begin(), out_.advice.end(), [](const auto& a, const auto& b) {
        return a.change.cost_s < b.change.cost_s;
      });
    }
    choose_cheapest();
    if (!out_.cheapest) choose_best();
  }

  // With all ties, since representative ones may be a hair off.
  void confirm(Advice& advice) const {
    if (auto full = advice_on(advice.change, Detail::kAll)) advice = std::move(*full);
  }

  void choose_cheapest() {
    for (std::size_t i = 0; i < out_.advice.size(); ++i) {
      if (!out_.advice[i].reaches_goal) continue;
      confirm(out_.advice[i]);
      if (!out_.advice[i].reaches_goal) continue;
      out_.cheapest = static_cast<int>(i);
      return;
    }
  }

  void choose_best() {
    double smallest = larger(out_.worst);
    for (std::size_t i = 0; i < out_.advice.size(); ++i) {
      if (larger(out_.advice[i].worst) >= smallest) continue;
      smallest = larger(out_.advice[i].worst);
      out_.best = static_cast<int>(i);
    }
    if (out_.best) confirm(out_.advice[at(*out_.best)]);
  }

  // Of those that leave ever fewer unobservable the last that does so with all ties, too.
  void choose_without_goal() {
    std::vector<int> better;
    std::size_t fewest = out_.flight.unobservable.size();
    for (std::size_t i = 0; i < out_.advice.size(); ++i) {
      if (out_.advice[i].unobservable.size() >= fewest) continue;
      fewest = out_.advice[i].unobservable.size();
      better.push_back(static_cast<int>(i));
    }
    for (; !better.empty(); better.pop_back()) {
      Advice& advice = out_.advice[at(better.back())];
      confirm(advice);
      if (advice.unobservable.size() < out_.flight.unobservable.size()) break;
    }
    for (const int i : better) out_.advice[at(i)].reaches_goal = true;
    if (!better.empty()) out_.cheapest = better.back();
  }

  Flight flight_;
  Options options_;
  Summary out_;
};

}  // namespace

Result<Summary> plan(const Flight& flight, const Options& options) {
  return Planner(flight, options).make();
}

}  // namespace plumbline::plan
