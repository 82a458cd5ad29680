// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>

#include "map/metric_layout.hpp"
#include "map/topological_map.hpp"
#include "wire/link_messages.hpp"

namespace homeward::wire {

/// Adds the part of the map around the path of an order made by order_for_route, so that the robot knows by itself
/// where it is: `layout` (map::metric_layout of this map) and the places `nearby`, none of the route's. Nothing is
/// added where the layout does not hold all of the path, and of `nearby`, most important first, no more than a message
/// of the link may hold. Precondition: the places are in the map.
void add_surroundings(const map::TopologicalMap& map, const map::MetricLayout& layout, std::span<const PlaceId> nearby,
                      MissionOrder& order);

/// Whether a person drew the way, and no tour drove it nor was it proposed as a shortcut.
bool drawn_by_a_person(const map::TopologicalMap& map, const PlaceId& from, const PlaceId& to);

/// A way by a person, which an order has driven as slowly as a shortcut, is driven as others: a mission has driven it.
void confirm_way(const PlaceId& from, const PlaceId& to, MissionOrder& order);

/// Takes a way out of those that an order says that a tour drove, both directions of it: it is closed for now, so that
/// something on it says nothing of where the robot is. Nothing where the order does not tell of it.
void leave_out_way(const PlaceId& from, const PlaceId& to, MissionOrder& order);

/// The path part of a mission: the places of a route with their prototypes' appearances and what the map knows of the
/// ways between them, and the destination's own picture, to whose heading the robot turns. Ways that a person drew are
/// driven slowly, until confirm_way. Ids, order, permit and speed
/// are the caller's. Precondition: the places are in the map.
MissionOrder order_for_route(const map::TopologicalMap& map, std::span<const PlaceId> route,
                             const map::Destination& destination);

/// The same to a place that is no destination: its prototype is what is homed to, and the heading is left as it is.
MissionOrder order_for_route(const map::TopologicalMap& map, std::span<const PlaceId> route);

}  // namespace homeward::wire
