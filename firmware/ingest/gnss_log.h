// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "edge/base/gnss_fix.h"
#include "edge/base/result.h"
#include "edge/geodesy/local_frame.h"
#include "edge/gnss/antenna_track.h"
#include "edge/gnss/nmea_sentences.h"
#include "firmware/ingest/photo_record.h"

namespace plumbline::ingest {

// A receiver's log as read: NMEA, or RTKLIB's .llh and .pos, told apart by what is in it.
struct GnssLog {
  std::string name;  // of the file
  std::vector<GnssFix> fixes;
  bool time_marks = false;  // one line per exposure (an events file), not a running receiver
  bool date_known = true;   // false: only times of day are true, days are counted from 1970-01-01
  std::optional<gnss::BasePosition> base;
  std::vector<std::string> warnings;  // sentences
};

// Fails where the file cannot be read, is empty, is neither kind, or holds no position at all. A
// file with "event" in its name (RTKLIB writes NAME_events.pos) holds time marks; other .pos files
// do where their times are not those of a running receiver.
Result<GnssLog> read_gnss_log(const std::filesystem::path& path);

// GNSS time = camera's clock + seconds.
struct TimeOffset {
  double seconds = 0;
  double sigma_s = 0.02;  // exposure delays of cameras differ by so much
};

// "S" or "S,SIGMA".
Result<TimeOffset> parse_time_offset(std::string_view text);

struct PhotoMoment {
  std::string name;
  PhotoTime time;
};

struct AntennaAtPhoto {
  geodesy::Geodetic position;
  // East, north, up at the position: the receiver's, of interpolation, and velocity times what the
  // time of this exposure alone leaves open.
  Eigen::Matrix3d covariance_enu_m2 = Eigen::Matrix3d::Zero();
  // Empty where the common error of time does not move it: at a time mark.
  std::optional<Eigen::Vector3d> velocity_enu_m_s;
  FixQuality quality = FixQuality::kNone;
  UtcTime utc;
  bool sigma_assumed = false;  // the receiver stated none
};

struct AntennaPositions {
  std::vector<std::optional<AntennaAtPhoto>> photos;  // one per photo asked for, in its order
  double common_time_sigma_s = 0;  // of all exposures in GNSS time alike; in no covariance
  std::optional<gnss::BasePosition> base;
  std::vector<std::string> warnings;  // sentences, those of the log among them
};

// Where the antenna was at each exposure.
//
// A log of epochs is interpolated at UTC of the photo + the offset. UTC comes from
// OffsetTimeOriginal or the photo's GPS time; where the time zone is not known, a time offset of a
// quarter of an hour or more (or any, where nothing else tells the zone) is taken from the camera's
// clock as shown, and without one the call fails and asks for it. Without --time-offset the clock
// is taken as true to 0.1 s. Whole-second stamps are cut, not rounded: half a second is added where
// no offset was given, and 0.29 s of sigma always.
//
// Time marks are matched by count and spacing (gnss::match_events), with the camera's clock used
// for its intervals only; --time-offset, where given, must agree with the result.
//
// Fails where no photo has a time, none falls into the log, or marks cannot be matched in exactly
// one way. A photo outside the log, or in a gap of more than 2 s, is empty and named in a warning.
Result<AntennaPositions> antenna_at_photos(const GnssLog& log,
                                           const std::vector<PhotoMoment>& photos,
                                           const std::optional<TimeOffset>& time_offset,
                                           const gnss::TrackOptions& track = {});

}  // namespace plumbline::ingest
