// SPDX-License-Identifier: MIT
#include "tests/edge/timing/arrival_laws.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace plumbline::timing {
namespace {

using sim::Random;

double exponential(double mean, Random& random) { return -mean * std::log(1 - random.uniform()); }

double weibull(double shape, double scale, Random& random) {
  return scale * std::pow(exponential(1, random), 1 / shape);
}

// Independent from epoch to epoch.
template <typename Draw>
NamedLaw independent(std::string name, Draw draw) {
  return {std::move(name), [draw](Random&) -> ArrivalLaw {
            return [draw](double, Random& random) { return draw(random); };
          }};
}

// Then it waits for the next poll, whose phase on the host's clock stays as it is.
NamedLaw polled(std::string name, std::chrono::milliseconds poll, double mean_s) {
  const double step_s = std::chrono::duration<double>(poll).count();
  const auto begun = [step_s, mean_s](Random& flight) -> ArrivalLaw {
    return [step_s, mean_s, phase = flight.uniform()](double host_s, Random& random) {
      const double late_s = exponential(mean_s, random);
      const double steps = (host_s + late_s) / step_s - phase;
      return late_s + step_s * (std::ceil(steps) - steps);
    };
  };
  return {std::move(name), begun, poll};
}

// Behind other outputs of the receiver, two a second at random moments, 60 ms each on average, one
// after the other on the same line.
NamedLaw queued() {
  return {"queue", [](Random& flight) -> ArrivalLaw {
            return
                [free_s = 0.0, next_s = flight.uniform()](double host_s, Random& random) mutable {
                  for (; next_s < host_s; next_s += exponential(0.5, random)) {
                    free_s = std::max(free_s, next_s) + exponential(60e-3, random);
                  }
                  return std::max(0.0, free_s - host_s) + exponential(1e-3, random);
                };
          }};
}

// Positioning takes as long as the sky asks for, which changes within half a minute.
NamedLaw wandering() {
  return {"wandering", [](Random& flight) -> ArrivalLaw {
            return [load = flight.normal(), last_s = -1.0](double host_s, Random& random) mutable {
              const double kept = last_s < 0 ? 1 : std::exp(-(host_s - last_s) / 30);
              last_s = host_s;
              load = kept * load + std::sqrt(1 - kept * kept) * random.normal();
              return 8e-3 * std::abs(load) + exponential(4e-3, random);
            };
          }};
}

double gamma_of_three(Random& random) {
  return exponential(8e-3, random) + exponential(8e-3, random) + exponential(8e-3, random);
}

}  // namespace

std::vector<NamedLaw> arrival_laws() {
  using std::chrono::milliseconds;
  return {
      independent("quiet", [](Random& r) { return r.uniform(0, 50e-6); }),
      independent("short_tail", [](Random& r) { return exponential(2e-3, r); }),
      independent("gamma_half", [](Random& r) { return 10e-3 * std::pow(r.normal(), 2); }),
      independent("gamma_3", gamma_of_three),
      independent("weibull_07", [](Random& r) { return weibull(0.7, 20e-3, r); }),
      independent("weibull_15", [](Random& r) { return weibull(1.5, 25e-3, r); }),
      independent("weibull_3", [](Random& r) { return weibull(3, 25e-3, r); }),
      // Has no floor at all, in practice.
      independent("lognormal", [](Random& r) { return 10e-3 * std::exp(0.8 * r.normal()); }),
      polled("usb_1ms", milliseconds(1), 3e-3),
      polled("usb_1ms_quiet", milliseconds(1), 0.2e-3),
      polled("usb_8ms", milliseconds(8), 3e-3),
      polled("usb_8ms_quiet", milliseconds(8), 0.2e-3),
      queued(),
      wandering(),
  };
}

}  // namespace plumbline::timing
