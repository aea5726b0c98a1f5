// SPDX-License-Identifier: MIT
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "drivers/storage.h"
#include "edge/base/gnss_fix.h"
#include "edge/capture/capture_plan.h"
#include "edge/capture/decisions.h"
#include "edge/geodesy/local_frame.h"
#include "edge/plan/flight.h"

namespace plumbline::service {

// A photo of the flight that is under way, by what was known of its place when it was decided.
struct FlownPhoto {
  capture::Target target;
  geodesy::Geodetic place;
  double height_m = 0;  // above the take-off point
  Eigen::Matrix3d covariance_m2 = Eigen::Matrix3d::Zero();
  Eigen::Vector3d velocity_m_s = Eigen::Vector3d::Zero();
  FixQuality quality = FixQuality::kNone;
  bool jumped = false;  // the position may be wrong, whatever its quality
};

// Empty where no place was known. `frame` is that of the run of the program which took it.
std::optional<FlownPhoto> flown_photo(const capture::PhotoTaken& taken,
                                      const std::optional<geodesy::LocalFrame>& frame);

// The photos that a flight had when its program was stopped in the air, by its journal: those that
// are on the disk. None where there is no journal or no photo.
std::vector<FlownPhoto> photos_before(Storage& storage, const std::string& flight,
                                      const capture::CaptureOptions& options);

// Heights of the plan that are still to come if the pilot goes on as planned, in their order. None
// once the drone has gone on aside.
std::vector<double> heights_to_come(const capture::CapturePlan& plan,
                                    const std::vector<FlownPhoto>& photos);

// As the planner takes it: photos taken with what is known of the place of each, about the last
// one, and photos to come above or below that. A position that had jumped counts as one without
// corrections does. Where not one has a fixed position, no position
// counts: what is measured then is shape. `latency_sigma_s` is that of the receiver's latency,
// which moves all photos alike; 0: pulses per second do without.
plan::Flight flight_of(const std::vector<FlownPhoto>& photos, const std::vector<double>& to_come_m,
                       double latency_sigma_s);

int photos_without_fix(const std::vector<FlownPhoto>& photos);

}  // namespace plumbline::service
