// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "core/range_sweep.hpp"

namespace homeward::driving {

using Scan = RangeSweep;

/// The points that a sweep hit, robot frame.
std::vector<Eigen::Vector2d> hit_points(const Scan& scan);

/// Whether the sweep's rays cover everything within 60 degrees of straight back from the robot.
bool looks_behind(const Scan& scan);

}  // namespace homeward::driving
