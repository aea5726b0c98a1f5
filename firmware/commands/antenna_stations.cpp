// SPDX-License-Identifier: MIT
#include "firmware/commands/antenna_stations.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "firmware/ingest/station_sigmas.h"

namespace plumbline::commands {
namespace {

// Of a velocity from positions of a centimetre, a few in a second. What it makes of a common error
// of time is each photo's own.
constexpr double kVelocitySigma_m_s = 0.05;

ingest::PhotoFix kind_of(FixQuality quality) {
  if (quality == FixQuality::kFixed) return ingest::PhotoFix::kFixed;
  return quality == FixQuality::kFloat ? ingest::PhotoFix::kFloat : ingest::PhotoFix::kSingle;
}

Status set_frame(const ingest::AntennaPositions& antenna,
                 std::optional<geodesy::LocalFrame>& frame) {
  for (const auto& at : antenna.photos) {
    if (frame || !at) continue;
    auto made = geodesy::LocalFrame::at(at->position);
    if (!made) return made.error();
    frame = *made;
  }
  return Done{};
}

// Without a fixed position: one offset and one drift for all, and little of each one's own.
void share_errors(const ingest::AntennaPositions& antenna, survey::Input& survey) {
  std::vector<ingest::PhotoPosition> positions;
  for (const auto& at : antenna.photos) {
    if (!at) continue;
    ingest::PhotoPosition position;
    position.fix = kind_of(at->quality);
    position.sigma_enu_m = at->covariance_enu_m2.diagonal().cwiseMax(0).cwiseSqrt();
    positions.push_back(position);
  }
  const bool fixed = std::any_of(positions.begin(), positions.end(), [](const auto& position) {
    return position.fix == ingest::PhotoFix::kFixed;
  });
  if (fixed || positions.empty()) return;
  std::vector<const ingest::PhotoPosition*> list;
  for (const auto& position : positions) list.push_back(&position);
  const bool times_known = std::all_of(survey.photos.begin(), survey.photos.end(),
                                       [](const auto& photo) { return photo.time_s.has_value(); });
  const auto sigmas = ingest::station_sigmas(list, times_known);
  survey.gnss = sigmas.common;
  std::size_t next = 0;
  for (orient::Photo& photo : survey.photos) {
    if (!photo.station) continue;
    photo.station->covariance_m2 = sigmas.white_m[next++].cwiseAbs2().asDiagonal();
  }
}

}  // namespace

Status place_antennas(const ingest::AntennaPositions& antenna,
                      std::optional<geodesy::LocalFrame>& frame, survey::Input& survey) {
  if (Status set = set_frame(antenna, frame); !set) return set;
  survey.gnss = {};
  survey.delay = {0, antenna.common_time_sigma_s};
  for (std::size_t i = 0; i < antenna.photos.size(); ++i) {
    orient::Photo& photo = survey.photos[i];
    photo.station.reset();
    const auto& at = antenna.photos[i];
    if (!at) continue;
    const Eigen::Matrix3d turn = frame->enu_from_enu_at(at->position);
    photo.station = orient::Station{frame->enu_of(at->position),
                                    turn * at->covariance_enu_m2 * turn.transpose()};
    photo.velocity_in_enu_m_s.reset();
    if (at->velocity_enu_m_s) {
      photo.velocity_in_enu_m_s = turn * *at->velocity_enu_m_s;
      photo.station->covariance_m2.diagonal().array() +=
          std::pow(kVelocitySigma_m_s * antenna.common_time_sigma_s, 2);
    }
  }
  share_errors(antenna, survey);
  return Done{};
}

}  // namespace plumbline::commands
