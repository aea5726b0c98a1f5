// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>

#include "edge/base/gnss_fix.h"

namespace plumbline::gnss {

// GPS time as a civil calendar shows it: like UtcTime, but without leap seconds since 1980-01-06.
using GpsCivilTime = std::chrono::local_time<std::chrono::microseconds>;

// Seconds by which GPS time is ahead of UTC: 18 since 2017-01-01.
// Source: IERS Bulletin C, the list of announced leap seconds.
std::chrono::seconds gps_minus_utc(GpsCivilTime gps);

// During an inserted second the UTC second before it is given twice.
UtcTime utc_of(GpsCivilTime gps);

// Week number (not truncated to 1024) and time of week to GPS time.
GpsCivilTime gps_time_of(int week, std::chrono::microseconds time_of_week);

}  // namespace plumbline::gnss
