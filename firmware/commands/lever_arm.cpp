// SPDX-License-Identifier: MIT
#include "firmware/commands/lever_arm.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "edge/base/units.h"

namespace plumbline::commands {
namespace {

constexpr double kSigmaM = 0.005;  // a tape held to two antennas
constexpr double kAirframeLeanRad = 5 * kRadPerDeg;

Result<std::vector<double>> numbers(const std::string& text) {
  std::vector<double> values;
  const char* at = text.data();
  const char* const end = at + text.size();
  while (at <= end) {
    double value = 0;
    const auto [next, error] = std::from_chars(at, end, value);
    if (error != std::errc() || !std::isfinite(value) || (next != end && *next != ',')) {
      return Error{"--lever-arm '" + text + "' is not R,U,B[,SIGMA] in metres."};
    }
    values.push_back(value);
    if (next == end) return values;
    at = next + 1;
  }
  return values;
}

}  // namespace

Result<orient::LeverArm> parse_lever_arm(const std::string& text, const std::string& frame,
                                         const std::vector<orient::Photo>& photos) {
  const auto values = numbers(text);
  if (!values) return values.error();
  if (values->size() < 3 || values->size() > 4 || (values->size() == 4 && (*values)[3] < 0)) {
    return Error{"--lever-arm '" + text + "' is not R,U,B[,SIGMA] in metres."};
  }
  const Eigen::Vector3d arm((*values)[0], (*values)[1], (*values)[2]);
  orient::LeverArm lever{arm, values->size() == 4 ? (*values)[3] : kSigmaM};
  if (frame == "photo") return lever;
  const bool attitudes = std::all_of(photos.begin(), photos.end(),
                                     [](const auto& photo) { return photo.attitude.has_value(); });
  if (!attitudes) {
    return Error{
        "--lever-frame body needs the attitude of each photo, which these photos do not "
        "state; give the arm in the photo's frame (--lever-frame photo)."};
  }
  lever.in_photo_m = {arm.x(), -arm.z(), arm.y()};
  lever.sigma_m = std::hypot(lever.sigma_m, kAirframeLeanRad * arm.norm());
  return lever;
}

}  // namespace plumbline::commands
