// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "map/topological_map.hpp"

namespace homeward::map {

/// A place that one of two maps has, or that both have and not alike.
struct PlaceDifference {
  PlaceId id;
  std::optional<Place> before;  // nothing: it is new
  std::optional<Place> after;   // nothing: it is gone
  std::vector<ImageId> gained;  // images, in the order of the place
  std::vector<ImageId> left;
};

struct EdgeDifference {
  PlaceId from;
  PlaceId to;
  std::optional<Edge> before;
  std::optional<Edge> after;
};

struct DestinationDifference {
  DestinationId id;
  std::optional<Destination> before;
  std::optional<Destination> after;
};

/// A hypothesis, or a shortcut, that was decided otherwise.
struct DecisionDifference {
  ImageId image_a;
  ImageId image_b;
  Decision before = Decision::kUndecided;
  Decision after = Decision::kUndecided;
};

/// What is other in a later state of a map.
struct MapDifference {
  std::vector<PlaceDifference> places;  // in the order of the later map, then what is gone
  std::vector<EdgeDifference> edges;
  std::vector<DestinationDifference> destinations;
  std::vector<DecisionDifference> hypotheses;
  int parts_before = 0;  // that the map falls into (map/parts.hpp)
  int parts_after = 0;

  [[nodiscard]] bool empty() const {
    return places.empty() && edges.empty() && destinations.empty() && hypotheses.empty();
  }
};

/// Compares two states of one map by its ids. Of edges counts what is driven by: that they are there, their bearing,
/// whether they are weak or blocked, who put them there.
MapDifference difference(const TopologicalMap& before, const TopologicalMap& after);

}  // namespace homeward::map
