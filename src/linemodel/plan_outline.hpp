// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <limits>
#include <vector>

#include "linemodel/plan.hpp"

namespace homeward::linemodel {

/// An edge of a plan seen from above, in the frame of the plan.
struct FlatSegment {
  Eigen::Vector2f from_m = Eigen::Vector2f::Zero();
  Eigen::Vector2f to_m = Eigen::Vector2f::Zero();
};

/// Which heights of a plan are looked at: edges that are in them, wholly or partly.
struct HeightRange {
  float from_m = -std::numeric_limits<float>::infinity();
  float to_m = std::numeric_limits<float>::infinity();
};

struct PlanOutline {
  std::vector<FlatSegment> segments;
  std::size_t total = 0;  // how many there are
};

/// What a plan looks like from above, for people: its edges as flat segments, in their order. Edges that lie on each
/// other to a centimetre (the foot and the head of a wall) come once, in either direction; upright ones are left out.
/// Of more than `most` the longest are kept.
PlanOutline outline(const std::vector<PlanLine>& lines, const HeightRange& heights, std::size_t most);

}  // namespace homeward::linemodel
