// SPDX-License-Identifier: MIT
#include "sim/release_wire.h"

#include <utility>

namespace plumbline::sim {

ReleaseWire::ReleaseWire(Clock& clock, const Options& options,
                         std::function<void(HostTime)> release)
    : clock_(clock), options_(options), random_(options.seed, 1), release_(std::move(release)) {}

Result<Pulse> ReleaseWire::pulse() {
  const HostTime before = clock_.now();
  const double error_s = in_seconds(options_.delay_sigma) * random_.normal();
  release_(before + options_.delay + from_seconds(error_s));
  Signal never;
  clock_.wait(never, before + options_.width);
  return Pulse{before, before, options_.width};
}

Status ReleaseWire::listen(Sink /*sink*/) {
  return Error{"The simulated shutter has no wire back; its frames say when it exposed."};
}

}  // namespace plumbline::sim
