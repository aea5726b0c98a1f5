// SPDX-License-Identifier: MIT
#pragma once

#include <numbers>

namespace plumbline {

inline constexpr double kRadPerDeg = std::numbers::pi / 180.0;
inline constexpr double kDegPerRad = 180.0 / std::numbers::pi;
inline constexpr double kSecondsPerMicrosecond = 1e-6;

}  // namespace plumbline
