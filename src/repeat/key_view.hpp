// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/two_view.hpp"
#include "repeat/arc_pose.hpp"
#include "repeat/arc_surroundings.hpp"
#include "repeat/landmark_follower.hpp"

namespace homeward::repeat {

/// The two-view geometry from the current picture to a key image (W_t:i of Segvic et al. 2007, §2.2.2), and the pose
/// that it means: its turn and direction are those of the pictures alone, its length that of the arc's landmarks.
struct KeyView {
  int key = 0;
  ArcPose pose;
  std::vector<std::size_t> landmarks;  // that the geometry was asked about
  std::vector<bool> agrees;            // as many
  int agreeing = 0;
  double error_px = 0.0;
  bool has_baseline = false;
  bool has_length = false;  // without: the landmarks do not tell it; the position is the key image's
};

/// Nothing where too few landmarks are seen in both pictures, or no motion explains them.
std::optional<KeyView> view_of_key(const LandmarkFollower& follower, const ArcSurroundings& around, int key,
                                   const geometry::TwoViewConfig& config, std::uint64_t seed);

}  // namespace homeward::repeat
