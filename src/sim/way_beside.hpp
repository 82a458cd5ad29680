// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/scene.hpp"

namespace homeward::sim {

/// Points every `step_m` along a way (m), its two ends included; the step is made to fit. Precondition: `way_m` is not
/// empty.
std::vector<Eigen::Vector2d> resampled(const std::vector<Eigen::Vector2d>& way_m, double step_m);

/// A way beside another one: `beside_m` to its left (negative: to its right) where the floor between is set, else as
/// far as it is, and never more slantwise than 1 in 3 to it. `way_m`: over set cells, metres. Where the way turns, what
/// would go back is left out. Empty for fewer than two points.
std::vector<Eigen::Vector2d> way_beside(const FloorGrid& drivable, const std::vector<Eigen::Vector2d>& way_m,
                                        double beside_m);

}  // namespace homeward::sim
