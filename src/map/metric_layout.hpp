// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <unordered_map>

#include "core/pose2.hpp"
#include "map/topological_map.hpp"

namespace homeward::map {

/// Where a picture of a map was taken, in a frame that all pictures of its component share.
struct LaidOutImage {
  Pose2 map_from_robot;  // metres; for a robot that stood where the picture was taken
  int component = 0;     // poses of different components have nothing to do with each other
  bool metric = false;   // lengths around it were measured by odometry; else they are guesses from time or pictures
};

using MetricLayout = std::unordered_map<ImageId, LaidOutImage>;

/// Poses of all prototypes, of all destinations' pictures and of all pictures with odometry: the most probable ones by
/// the odometry between pictures that follow each other, the directions and turns of edges, and that pictures of one
/// place were taken near to each other (a pose graph, Lu & Milios 1997, with Cauchy's robust loss on what pictures
/// say). Good to some decimetres between places that are some metres apart; farther apart it is as good as the tour's
/// odometry and its closed loops. Same map, same poses.
MetricLayout metric_layout(const TopologicalMap& map);

}  // namespace homeward::map
