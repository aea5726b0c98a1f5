// SPDX-License-Identifier: MIT
#include "edge/plan/changes.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

namespace plumbline::plan {
namespace {

constexpr double kAsideM[] = {2, 5, 10, 20};
constexpr double kLongerM[] = {10, 20, 40, 60};
constexpr double kLeastAsideM = 1;
// In pairs smaller steps aside are left out: they do little for a flight that nothing alone helps,
// and the answer is due within a second.
constexpr double kPairedAsideM = 10;
constexpr int kMostMorePhotos = 40;

std::string metres(double value) {
  char buffer[32];
  std::snprintf(buffer, sizeof buffer, "%.6g", value);
  return buffer;
}

// As one says it: a photo taken in the air lies at 36.6522 m.
std::string about_metres(double value) { return metres(std::round(10 * value) / 10); }

std::string photos(std::size_t count) {
  return count == 1 ? "one more photo" : std::to_string(count) + " more photos";
}

// Where nobody has been yet: east, or across from the photo that is farthest aside.
Eigen::Vector3d aside_direction(const Flight& flight) {
  const Eigen::Vector2d foot = foot_of(flight);
  Eigen::Vector2d farthest(0, 0);
  for (const Eigen::Vector3d& place : flight.all_m()) {
    const Eigen::Vector2d off = place.head<2>() - foot;
    if (off.norm() > farthest.norm()) farthest = off;
  }
  if (farthest.norm() < kLeastAsideM) return Eigen::Vector3d::UnitX();
  farthest.normalize();
  return {-farthest.y(), farthest.x(), 0};
}

class Maker {
 public:
  Maker(const Flight& flight, const Options& options)
      : flight_(flight),
        options_(options),
        top_m_(highest_m(flight)),
        bottom_m_(lowest_m(flight)),
        step_m_(usual_step_m(flight)) {
    const Eigen::Vector2d foot = foot_of(flight);
    foot_ = {foot.x(), foot.y(), 0};
  }

  std::vector<Change> make() {
    for (const double d : kAsideM) add_aside(d);
    for (const double d : kAsideM) add_l(d);
    for (const double d : kLongerM) add_up(d);
    for (const double d : kLongerM) add_down(d);
    add_between();
    add_heading(2, options_.costs.heading_2deg_s);
    add_heading(1, options_.costs.heading_1deg_s);
    add_length();
    add_control();
    return std::move(changes_);
  }

 private:
  double stops(std::size_t count) const {
    return options_.costs.stop_s * static_cast<double>(count);
  }
  Eigen::Vector3d on_line(double height_m) const { return foot_ + Eigen::Vector3d(0, 0, height_m); }

  void add_aside(double d) {
    if (d < options_.least_aside_m) return;
    Change change;
    change.what = "one more photo " + metres(d) + " m aside, at " + about_metres(top_m_) + " m";
    change.options = "--side-step " + metres(d);
    change.aside_m = d;
    change.photos_m = {on_line(top_m_) + d * aside_direction(flight_)};
    change.cost_s = 2 * d / options_.costs.aside_rate_m_s + stops(1);
    changes_.push_back(change);
  }

  void add_l(double d) {
    if (d < options_.least_aside_m) return;
    const Eigen::Vector3d first = aside_direction(flight_);
    const Eigen::Vector3d second(-first.y(), first.x(), 0);
    Change change;
    change.what = "an L: two more photos, " + metres(d) + " m aside and " + metres(d) +
                  " m across, at " + about_metres(top_m_) + " m";
    change.options = "--side-step " + metres(d) + "," + metres(d);
    change.aside_m = d;
    change.across = true;
    change.photos_m = {on_line(top_m_) + d * first, on_line(top_m_) + d * (first + second)};
    change.cost_s = (2 + std::numbers::sqrt2) * d / options_.costs.aside_rate_m_s + stops(2);
    changes_.push_back(change);
  }

  void add_up(double d) {
    Change change;
    const double end = top_m_ + d;
    if (end > options_.ceiling_m || d / step_m_ > kMostMorePhotos) return;
    for (double h = top_m_ + step_m_; h < end + 1e-6; h += step_m_) {
      change.photos_m.push_back(on_line(h));
    }
    if (change.photos_m.empty()) return;
    change.what =
        "climb on to " + about_metres(end) + " m (" + photos(change.photos_m.size()) + ")";
    change.options = "--to " + metres(end);
    change.climb_m = end;
    change.cost_s = 2 * d / options_.costs.climb_rate_m_s + stops(change.photos_m.size());
    changes_.push_back(change);
  }

  // The drone passes there anyway, on its way down if not up.
  void add_down(double d) {
    Change change;
    const double start = bottom_m_ - d;
    if (start < options_.floor_m || d / step_m_ > kMostMorePhotos) return;
    for (double h = bottom_m_ - step_m_; h > start - 1e-6; h -= step_m_) {
      change.photos_m.push_back(on_line(h));
    }
    if (change.photos_m.empty()) return;
    change.what = "take photos from " + about_metres(start) + " m on (" +
                  photos(change.photos_m.size()) + ")";
    change.options = "--from " + metres(start);
    change.from_m = start;
    change.cost_s = stops(change.photos_m.size());
    changes_.push_back(change);
  }

  void add_between() {
    if (!options_.photos_between) return;
    Change change;
    change.step_m = 0.5 * step_m_;
    for (double h = bottom_m_ + 0.5 * step_m_; h < top_m_; h += step_m_) {
      change.photos_m.push_back(on_line(h));
    }
    if (change.photos_m.empty() || change.photos_m.size() > kMostMorePhotos) return;
    change.what = "a photo every " + about_metres(0.5 * step_m_) + " m instead of every " +
                  about_metres(step_m_) + " m (" + photos(change.photos_m.size()) + ")";
    change.options = "--step " + metres(0.5 * step_m_);
    change.cost_s = stops(change.photos_m.size());
    changes_.push_back(change);
  }

  void add_heading(double sigma_deg, double cost_s) {
    if (options_.heading_sigma_deg && *options_.heading_sigma_deg <= sigma_deg) return;
    Change change;
    change.what =
        "a heading known to " + metres(sigma_deg) + (sigma_deg == 1 ? " degree" : " degrees");
    change.options = "--heading-sigma " + metres(sigma_deg);
    change.heading_sigma_deg = sigma_deg;
    change.cost_s = cost_s;
    changes_.push_back(change);
  }

  // As long as half the ground that matters is wide.
  void add_length() {
    if (options_.known_length_m || !options_.radius_m) return;
    Change change;
    change.known_length_m = *options_.radius_m;
    change.what = "a known length of " + metres(*change.known_length_m) + " m on the ground, to " +
                  metres(1000 * options_.length_sigma_m) + " mm";
    change.options = "--known-length " + metres(*change.known_length_m);
    change.cost_s = options_.costs.length_s;
    changes_.push_back(change);
  }

  void add_control() {
    Change change;
    change.control_points = 1;
    change.what = "one control point far from the foot, known to " +
                  metres(1000 * options_.control_sigma_m) + " mm";
    change.options = "--control-points " + std::to_string(options_.control_points + 1);
    change.cost_s = options_.costs.control_s;
    changes_.push_back(change);
  }

  const Flight& flight_;
  const Options& options_;
  double top_m_, bottom_m_, step_m_;
  Eigen::Vector3d foot_;
  std::vector<Change> changes_;
};

std::vector<Change> by_cost(std::vector<Change> changes) {
  std::stable_sort(changes.begin(), changes.end(),
                   [](const Change& a, const Change& b) { return a.cost_s < b.cost_s; });
  return changes;
}

}  // namespace

std::vector<Change> single_changes(const Flight& flight, const Options& options) {
  return by_cost(Maker(flight, options).make());
}

std::vector<Change> paired_changes(const std::vector<Change>& singles) {
  std::vector<Change> pairs;
  for (const Change& aside : singles) {
    if (aside.aside_m < kPairedAsideM) continue;
    for (const Change& other : singles) {
      if (other.photos_m.empty() || other.aside_m > 0) continue;
      Change both = other;
      both.what += ", and " + aside.what;
      both.options += " " + aside.options;
      both.aside_m = aside.aside_m;
      both.across = aside.across;
      both.cost_s += aside.cost_s;
      both.photos_m.insert(both.photos_m.end(), aside.photos_m.begin(), aside.photos_m.end());
      pairs.push_back(both);
    }
  }
  return by_cost(std::move(pairs));
}

Flight changed(const Flight& flight, const Change& change) {
  Flight out = flight;
  out.ahead_m.insert(out.ahead_m.end(), change.photos_m.begin(), change.photos_m.end());
  return out;
}

Options changed(const Options& options, const Change& change) {
  Options out = options;
  if (change.heading_sigma_deg) out.heading_sigma_deg = change.heading_sigma_deg;
  if (change.known_length_m) out.known_length_m = change.known_length_m;
  out.control_points += change.control_points;
  return out;
}

double duration_s(const Flight& flight, const Costs& costs) {
  double seconds = 0;
  const std::vector<Eigen::Vector3d> places = flight.all_m();
  for (std::size_t i = 0; i < places.size(); ++i) {
    seconds += costs.stop_s;
    if (i == 0) continue;
    const Eigen::Vector3d way = places[i] - places[i - 1];
    seconds +=
        std::abs(way.z()) / costs.climb_rate_m_s + way.head<2>().norm() / costs.aside_rate_m_s;
  }
  return seconds + highest_m(flight) / costs.climb_rate_m_s;
}

}  // namespace plumbline::plan
