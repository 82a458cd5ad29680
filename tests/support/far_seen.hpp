// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "support/landmarks.hpp"

namespace homeward::testing {

/// Features of both.
inline features::Appearance together(const features::Appearance& a, const features::Appearance& b) {
  features::Appearance both;
  const auto under = [](const auto& first, const auto& second, auto& result) {
    result.resize(first.rows() + second.rows(), first.cols());
    result << first, second;
  };
  under(a.sift.bearings, b.sift.bearings, both.sift.bearings);
  under(a.sift.scales_rad, b.sift.scales_rad, both.sift.scales_rad);
  under(a.sift.descriptors, b.sift.descriptors, both.sift.descriptors);
  under(a.sift.colours, b.sift.colours, both.sift.colours);
  return both;
}

/// What is seen from `pose` of a target of which only things far off are the same from here, and the target's view.
struct FarSeen {
  Landmarks far;
  Landmarks near;
  Pose2 target{6.0, 0.0, 1.0};

  explicit FarSeen(int shared)
      : far(homeward::testing::landmarks_around({{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}}, shared, 7, 6.0, 14.0)),
        near(homeward::testing::landmarks_around({{0.0, 0.0, 0.0}, {6.0, 0.0, 0.0}}, 600, 8)) {}
  [[nodiscard]] features::Appearance from(const Pose2& pose, std::uint64_t seed) const {
    return together(seen_from(far, pose, seed), seen_from(near, pose, seed + 1, 1.0));
  }
};

}  // namespace homeward::testing
