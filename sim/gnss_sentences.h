// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "edge/base/gnss_fix.h"
#include "edge/geodesy/local_frame.h"
#include "sim/gnss_error.h"

namespace plumbline::sim {

// What a receiver says of one epoch.
struct SaidEpoch {
  UtcTime utc;
  FixQuality quality = FixQuality::kFixed;  // kNone: no position
  geodesy::Geodetic place;
  double separation_m = 0;
  SigmaPair sigma;
};

// "GNGGA,..." as a line with '$', checksum and line end.
std::string nmea_line(const std::string& body);

// In the manner of Emlid: 7 decimals of a minute, heights in millimetres, hundredths of a second.
std::string gga_of(const SaidEpoch& epoch);
std::string gst_of(const SaidEpoch& epoch);
std::string rmc_of(const SaidEpoch& epoch);

// A line of RTKLIB's in GPS time; empty without position. `llh_header()` names the columns.
std::string llh_of(const SaidEpoch& epoch);
std::string llh_header();

}  // namespace plumbline::sim
