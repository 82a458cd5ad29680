// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "core/ids.hpp"
#include "map/no_route.hpp"
#include "map/topological_map.hpp"

namespace homeward::wire {

/// The way from one place to a neighbour.
struct WayView {
  PlaceId from;
  PlaceId to;
};

/// A way through a map.
struct RouteView {
  std::vector<PlaceId> places;
  double cost_m = 0.0;
  double length_m = 0.0;
  map::LengthSource length_from = map::LengthSource::kUnknown;
  double time_s = 0.0;
  std::vector<WayView> weak;
  std::vector<WayView> shortcuts = {};
};

/// The best way and, as `others`, the next best ones (proto/schemas/route.schema.json). Precondition: not empty.
nlohmann::json routes_to_json(const std::vector<RouteView>& routes);

/// That there is none, and why (proto/schemas/no_route.schema.json).
nlohmann::json no_route_to_json(const map::NoRoute& why, const map::TopologicalMap& map);

}  // namespace homeward::wire
