// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "map/topological_map.hpp"
#include "mapping/pair_table.hpp"

namespace homeward::testing {

/// Pictures of one tour, where they were taken, and what they tell of each other.
struct PosedDrive {
  std::vector<Pose2> truth;
  std::vector<map::MapImage> images;
  std::vector<int> tour_of;
  mapping::PairTable pairs{0};  // made once all pictures are there

  /// One more picture.
  void add(const Pose2& pose, const std::optional<Pose2>& odometry) {
    images.push_back({ImageId("t/" + std::to_string(1000 + truth.size())), std::nullopt, odometry});
    truth.push_back(pose);
    tour_of.push_back(0);
  }
};

/// What two pictures of these poses tell, exactly: the second seen from the first, walls some 5 m away.
inline mapping::PairRelation seen_between(const Pose2& a, const Pose2& b) {
  const Pose2 between = inverse(a) * b;
  mapping::PairRelation relation;
  relation.inliers = 60;
  relation.direction_rad = static_cast<float>(std::atan2(between.y_m, between.x_m));
  relation.turn_rad = static_cast<float>(between.theta_rad);
  relation.parallax_rad = static_cast<float>(0.2 * std::hypot(between.x_m, between.y_m));
  return relation;
}

}  // namespace homeward::testing
