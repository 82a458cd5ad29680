// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace homeward::linemodel {

/// The most corners of a polygon that is not convex.
inline constexpr std::size_t kMostCornersOfConcave = 100;

/// A flat polygon as triangles, each the indices of three of its corners: a fan where it is convex, ears cut off
/// otherwise (Meisters 1975). Corners in order along its rim, which does not cross itself; one that does gives
/// triangles all the same. Nothing where it is not convex and has more than 100 corners. A polygon of fewer than three
/// corners or without area has no triangles.
std::optional<std::vector<std::array<std::size_t, 3>>> triangles_of_polygon(std::span<const Eigen::Vector3d> corners);

}  // namespace homeward::linemodel
