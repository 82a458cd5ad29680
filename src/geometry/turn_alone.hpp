// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "geometry/seen_point.hpp"

namespace homeward::geometry {

/// A turn without a way between two views of one viewpoint.
struct TurnAlone {
  Eigen::Matrix3d current_from_target = Eigen::Matrix3d::Identity();  // rotation of bearings
  std::vector<double>
      off_px;  // of each pair: how far the turned target bearing lies from where the current view sees it
};

/// The turn that most pairs agree with within `most_off_px`: samples of two pairs, the best one fitted again to all
/// that agree (MSAC, then Kabsch 1976 with truncated weights). The identity for fewer than two pairs. Deterministic by
/// `seed`.
TurnAlone fit_turn(std::span<const PointPair> pairs, double most_off_px, std::uint64_t seed);

}  // namespace homeward::geometry
