// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>

#include "sim/scene.hpp"

namespace homeward::scenario {

/// The way of somebody who knows the plan and looks at as much of it, metres: from `from_m` past views from which all
/// but a fiftieth of the drivable floor lies within `covers_m` and in sight, ending at the last of them. For judging
/// explorations: a good way, not the shortest there is. Views are chosen greedily, each the one that covers most of
/// what is left; their order is exploration::visiting_order.
double known_plan_m(const sim::World& world, const Eigen::Vector2d& from_m, double covers_m);

}  // namespace homeward::scenario
