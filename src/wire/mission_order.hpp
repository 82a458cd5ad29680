// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "map/topological_map.hpp"
#include "wire/link_messages.hpp"

namespace homeward::wire {

/// The path part of a mission: the places of a route with their prototypes' appearances and what the map knows of the
/// ways between them, and the destination's own picture, to whose heading the robot turns. Ids, order, permit and speed
/// are the caller's. Precondition: the places are in the map.
MissionOrder order_for_route(const map::TopologicalMap& map, std::span<const PlaceId> route,
                             const map::Destination& destination);

/// The same to a place that is no destination: its prototype is what is homed to, and the heading is left as it is.
MissionOrder order_for_route(const map::TopologicalMap& map, std::span<const PlaceId> route);

}  // namespace homeward::wire
