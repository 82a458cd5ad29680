// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <numbers>
#include <span>

namespace homeward {

inline constexpr double kPi = std::numbers::pi;

/// The same direction in (-pi, pi].
double wrap_angle(double angle_rad);

/// The angle in `angles_rad` with the least sum of absolute wrapped differences to the others, in (-pi, pi].
/// Precondition: not empty. Exact up to the data points (a circular medoid); ties go to the first.
double circular_median(std::span<const double> angles_rad);

constexpr double radians(double degrees) { return degrees * kPi / 180.0; }
constexpr double degrees(double radians) { return radians * 180.0 / kPi; }

}  // namespace homeward
