// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <optional>
#include <vector>

#include "edge/base/gnss_fix.h"

namespace plumbline::gnss {

inline bool agrees(const std::optional<double>& value, const std::optional<double>& truth) {
  return !value || (truth && *value == *truth);
}

// Says nothing that the undamaged fix does not say; sigmas may be the held ones of the other.
inline bool says_nothing_wrong(const GnssFix& fix, const std::vector<GnssFix>& truth) {
  const auto same = std::find_if(truth.begin(), truth.end(), [&](const GnssFix& t) {
    return t.time_of_day == fix.time_of_day;
  });
  if (same == truth.end()) return !fix.latitude_deg.has_value();
  const bool sigma_known =
      !fix.covariance_enu_m2 || std::any_of(truth.begin(), truth.end(), [&](const GnssFix& t) {
        return t.covariance_enu_m2 == fix.covariance_enu_m2;
      });
  // RMC stands in for a lost first GGA; its letter D means any corrected solution.
  const bool quality_holds =
      fix.quality == same->quality ||
      (!fix.height_ellipsoidal_m && fix.quality == FixQuality::kDifferential);
  return (!fix.time || fix.time == same->time) && quality_holds && sigma_known &&
         agrees(fix.latitude_deg, same->latitude_deg) &&
         agrees(fix.longitude_deg, same->longitude_deg) &&
         agrees(fix.height_ellipsoidal_m, same->height_ellipsoidal_m) &&
         agrees(fix.correction_age_s, same->correction_age_s);
}

}  // namespace plumbline::gnss
