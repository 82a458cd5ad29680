// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "core/pose2.hpp"

namespace homeward::exploration {

/// What is known of two poses relative to each other.
struct PoseLink {
  int a = 0;
  int b = 0;
  Pose2 a_from_b;
  double spread_m = 0.02;
  double spread_rad = 0.01;
  bool loop = false;  // may be wrong: counts the less the more it contradicts the others (Cauchy)
};

/// The most probable poses by all links, the first one held; improved from where they are (a pose graph, Lu & Milios
/// 1997). A loop counts less from so many spreads on: `looseness`. Same input, same poses.
void settle(std::vector<Pose2>& poses, const std::vector<PoseLink>& links, double looseness = 1.0);

/// How far a link is from the poses, in units of its spread.
double strain(const std::vector<Pose2>& poses, const PoseLink& link);

}  // namespace homeward::exploration
