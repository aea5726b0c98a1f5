// SPDX-License-Identifier: MIT
#include "edge/capture/aim.h"

#include <algorithm>

namespace plumbline::capture {
namespace {

constexpr nanoseconds kStride = std::chrono::milliseconds(50);

// One stride of the way ahead.
struct Stride {
  Motion from;
  Motion to;
};

// Where a quantity that goes from `before` to `after` in a stride reaches `wanted`.
HostTime instant_of(const Stride& stride, double before, double after, double wanted) {
  const double share = std::clamp((wanted - before) / (after - before), 0.0, 1.0);
  const auto whole = std::chrono::duration<double, std::nano>(stride.to.time - stride.from.time);
  return stride.from.time + std::chrono::duration_cast<nanoseconds>(share * whole);
}

class Search {
 public:
  Search(const CapturePlan& plan, const HeightSteps& steps, const AimState& state)
      : plan_(plan), steps_(steps), state_(state) {}

  double height_m(const Motion& motion) const {
    return motion.height_ellipsoidal_m - state_.ground_height_m.value_or(0);
  }

  std::optional<Aim> in(const Stride& stride) const {
    std::optional<Aim> first;
    for (const auto& aim : {height_in(stride), aside_in(stride), distance_in(stride)}) {
      if (aim && (!first || aim->instant < first->instant)) first = aim;
    }
    return first;
  }

  bool is_grid_high(const Motion& motion) const { return height_m(motion) >= plan_.grid_from_m; }

 private:
  std::optional<Aim> height_in(const Stride& stride) const {
    const double from_m = height_m(stride.from);
    const double to_m = height_m(stride.to);
    const int entry = steps_.first_between(from_m, to_m);
    if (entry < 0) return std::nullopt;
    const double wanted_m = steps_.entries()[static_cast<std::size_t>(entry)].height_m;
    return Aim{{Reason::kHeight, entry, wanted_m},
               instant_of(stride, from_m, to_m, wanted_m),
               false,
               false};
  }

  std::optional<Aim> beside_in(const Stride& stride, double wanted_m, Reason reason) const {
    if (!state_.last_place_m) return std::nullopt;
    const double from_m = (stride.from.in_enu_m.head<2>() - *state_.last_place_m).norm();
    const double to_m = (stride.to.in_enu_m.head<2>() - *state_.last_place_m).norm();
    if (to_m < wanted_m) return std::nullopt;
    const HostTime instant =
        from_m >= wanted_m ? stride.from.time : instant_of(stride, from_m, to_m, wanted_m);
    return Aim{{reason, -1, 0}, instant, from_m > wanted_m + 1, false};
  }

  std::optional<Aim> aside_in(const Stride& stride) const {
    const bool asked = plan_.aside_m && steps_.any_taken() &&
                       state_.aside_taken < plan_.most_aside &&
                       height_m(stride.from) > steps_.lowest_m() - 1;
    return asked ? beside_in(stride, *plan_.aside_m, Reason::kAside) : std::nullopt;
  }

  std::optional<Aim> distance_in(const Stride& stride) const {
    if (!plan_.every_m || !is_grid_high(stride.from)) return std::nullopt;
    if (state_.last_place_m) return beside_in(stride, *plan_.every_m, Reason::kDistance);
    return Aim{{Reason::kDistance, -1, 0}, stride.from.time, false, false};
  }

  const CapturePlan& plan_;
  const HeightSteps& steps_;
  const AimState& state_;
};

// By the clock: in time for the grid, or because nothing else is known.
std::optional<Aim> by_time(nanoseconds every, Reason reason, const AimState& state, HostTime from) {
  const HostTime last = std::max(state.last_photo.value_or(state.flying_since), state.flying_since);
  const HostTime instant = std::max(last + every, from);
  if (instant > from + kLookAhead) return std::nullopt;
  return Aim{{reason, -1, 0}, instant, false, false};
}

std::optional<Aim> at_once(const Search& search, const HeightSteps& steps, const AimState& state,
                           const StillnessOptions& stillness, const Motion& here) {
  const double height_m = search.height_m(here);
  const int passed = steps.passed_at(height_m);
  const int paused = state.time_to_stop_waiting ? steps.near(height_m, stillness.within_m) : -1;
  const int entry = paused >= 0 ? paused : passed;
  if (entry < 0) return std::nullopt;
  const double wanted_m = steps.entries()[static_cast<std::size_t>(entry)].height_m;
  return Aim{{Reason::kHeight, entry, wanted_m},
             here.time,
             paused < 0 && steps.is_late(entry, height_m),
             paused >= 0 && state.at_rest};
}

}  // namespace

std::optional<Aim> next_aim(const CapturePlan& plan, const HeightSteps& steps,
                            const Navigator& navigator, const AimState& state,
                            const StillnessOptions& stillness, HostTime from) {
  const Search search(plan, steps, state);
  std::optional<Motion> here = navigator.at(from);
  if (!here || !state.ground_height_m) {
    return plan.blind_every ? by_time(*plan.blind_every, Reason::kBlind, state, from)
                            : std::nullopt;
  }
  if (const auto now = at_once(search, steps, state, stillness, *here)) return now;
  std::optional<Aim> aim;
  if (plan.every && search.is_grid_high(*here)) {
    aim = by_time(*plan.every, Reason::kTime, state, from);
  }
  for (HostTime time = from + kStride; time <= from + kLookAhead; time += kStride) {
    if (aim && aim->instant < time - kStride) break;
    std::optional<Motion> next = navigator.at(time);
    if (!next) break;
    const auto found = search.in({*here, *next});
    if (found && (!aim || found->instant < aim->instant)) return found;
    here = std::move(next);
  }
  return aim;
}

}  // namespace plumbline::capture
