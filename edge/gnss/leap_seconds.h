// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <optional>

#include "edge/base/gnss_fix.h"
#include "edge/base/time.h"

namespace plumbline::gnss {

// GPS time as a civil calendar shows it: like UtcTime, but without leap seconds since 1980-01-06.
using GpsCivilTime = std::chrono::local_time<std::chrono::microseconds>;

// Seconds by which GPS time is ahead of UTC: 18 since 2017-01-01.
// Source: IERS Bulletin C, the list of announced leap seconds.
std::chrono::seconds gps_minus_utc(GpsCivilTime gps);

// During an inserted second the UTC second after it is given, which so comes twice.
UtcTime utc_of(GpsCivilTime gps);

// Week number (not truncated to 1024) and time of week to GPS time.
GpsCivilTime gps_time_of(int week, std::chrono::microseconds time_of_week);

// The same on the clock that does not mix with others: nanoseconds since 1980-01-06. A fraction of
// a microsecond is rounded to the nearest.
UtcTime utc_of(GpsTime gps);

// The one instant that has this UTC; of a second that came twice, the later (the inserted second
// itself has no UtcTime of its own). Empty before 1980-01-06 and from 2262 on, where nanoseconds in
// 64 bits end. Leap seconds not yet announced are not known here.
std::optional<GpsTime> gps_of(UtcTime utc);

}  // namespace plumbline::gnss
