// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "linemodel/plan.hpp"

namespace homeward::linemodel {

/// A wall from above, without thickness: metres on the floor.
struct Wall {
  Eigen::Vector2d from_m = Eigen::Vector2d::Zero();
  Eigen::Vector2d to_m = Eigen::Vector2d::Zero();
};

/// The walls of a floor plan stood up: of each its foot, its top and its face, and an upright line wherever a wall ends
/// or meets others, but not where just two go on as one. Ends within 5 mm of one another are the same. Walls that are
/// there twice are stood up once. `where` names the file in errors. Errors: kInvalidInput (a height that is not between
/// 0.1 m and 100 m, a point more than 10 km away), kTooLarge (over 2,000,000 lines), kEmptyInput (no wall).
Result<Plan> extrude_walls(const std::vector<Wall>& walls, double height_m, const std::string& where);

}  // namespace homeward::linemodel
