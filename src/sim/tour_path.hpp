// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "core/result.hpp"
#include "sim/scene.hpp"

namespace homeward::sim {

/// Where one picture of a tour is taken.
struct TourStop {
  Pose2 pose;
  std::optional<std::string> room;     // that the pose lies in
  std::optional<std::string> arrived;  // the tour's room whose point this is, at its first visit
};

/// A guided tour from room to room, a picture every `step_m`, and in between where the robot turns on the spot.
/// Headings follow the way. `beside_m`: so far to the left of the usual way (negative: to the right) wherever the floor
/// allows it (see way_beside), a room's point then being where the tour is nearest to it. Errors: kNotFound (no such
/// room; says which there are), kTooFewImages (fewer than two rooms), kInvalidInput, kNoRoute.
Result<std::vector<TourStop>> plan_tour(const World& world, const std::vector<std::string>& rooms, double step_m,
                                        double beside_m = 0.0);

/// All rooms of a world from its first on, the next always the one whose point is nearest, and back to the first; of a
/// world that is a circuit, in the order in which they lie round it. Of a world with one room or none: those.
std::vector<std::string> all_rooms(const World& world);

/// The point of a room. Errors: kNotFound, which names the rooms there are.
Result<Eigen::Vector2d> room_point(const World& world, const std::string& room);

}  // namespace homeward::sim
