// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <Eigen/Core>
#include <map>
#include <optional>

#include "core/ids.hpp"
#include "core/pose2.hpp"
#include "map/topological_map.hpp"
#include "sim/motion.hpp"

namespace homeward::scenario {

/// Where pictures of a tour were truly taken. For judging only.
using PicturePoses = std::map<ImageId, Pose2>;

/// The shortest way over a map's edges in true metres, straight from prototype to prototype: from any place within a
/// metre of `from_m`, or else the nearest, to the picture of `to`. Blocked edges are not driven, shortcuts only if
/// asked. Nothing where there is none.
std::optional<double> way_over_edges_m(const map::TopologicalMap& map, const PicturePoses& poses,
                                       const Eigen::Vector2d& from_m, const map::Destination& to, bool shortcuts);

/// The least clearance of a body that drives straight from one point to another; negative where it would touch.
double clearance_along_m(const sim::Obstacles& obstacles, const sim::RobotProfile& robot, const Pose2& from,
                         const Pose2& to);

}  // namespace homeward::scenario
