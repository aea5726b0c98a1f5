// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/base/gnss_fix.h"

namespace plumbline::talk {

// What a receiver says in its epoch `epoch`, ten a second from 10:00:00 on: it stands still but for
// a last digit that counts the epochs, so that no two are the same.
std::string positions(int epoch);  // GGA and GST, once a second RMC
std::string without_position(int epoch);
std::string without_epochs(int epoch);  // GSV only
std::string noise(int epoch);           // as a line at another speed shows it
std::string jumped(int epoch);          // as positions(), 100 m farther north

// Whether the fix is exactly what positions() or jumped() said in its epoch.
bool was_said(const GnssFix& fix);

}  // namespace plumbline::talk
