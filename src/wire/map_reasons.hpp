// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "map/no_route.hpp"
#include "map/topological_map.hpp"
#include "map/tour_warning.hpp"
#include "wire/reason.hpp"

namespace homeward::wire {

/// Why no way of the map leads there. Precondition: it has the places.
Reason reason_of(const map::NoRoute& why, const map::TopologicalMap& map);

/// What is odd about a tour.
Reason reason_of(const map::TourWarning& warning);

}  // namespace homeward::wire
