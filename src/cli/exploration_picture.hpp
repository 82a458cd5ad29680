// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <unordered_map>

#include "core/ids.hpp"
#include "core/image.hpp"
#include "core/pose2.hpp"
#include "map/topological_map.hpp"
#include "scenario/exploration_run.hpp"
#include "sim/scene.hpp"

namespace homeward::cli {

/// The true plan of a world, what of its floor places cover (green; what none covers is red), the way that the robot
/// truly drove and the map's places and ways over it. `taken`: where the map's pictures were truly taken.
Image exploration_picture(const sim::World& world, const map::TopologicalMap& map,
                          const std::unordered_map<ImageId, Pose2>& taken, const scenario::ExplorationResult& explored);

/// The same of an exploration that is under way: the graph is that of its pictures, each with the one before and with
/// those by which it was known again, where the pictures were truly taken.
Image growing_picture(const sim::World& world, const exploration::Explorer& explorer,
                      const scenario::ExplorationResult& so_far);

}  // namespace homeward::cli
