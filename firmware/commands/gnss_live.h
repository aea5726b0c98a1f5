// SPDX-License-Identifier: MIT
#pragma once

#include "drivers/clock.h"
#include "drivers/gnss_receiver.h"
#include "edge/base/result.h"

namespace plumbline::commands {

// Shows what arrives until SIGINT or SIGTERM: fixes on standard output, what the receiver's state
// is in sentences on standard error, the counters last. On a terminal a line below the table says
// how it stands: fix, sigmas, satellites, rate, spread of the latency, errors, reconnections.
Status show_live(GnssReceiver& receiver, Clock& clock, bool json);

}  // namespace plumbline::commands
