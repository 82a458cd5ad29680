// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "map/graph.hpp"

namespace homeward::localisation {

/// A place, by its index in the map, and how probable it is.
struct PlaceShare {
  int place = 0;
  double probability = 0.0;
};

/// P(x | x') between places: a Gaussian of the number of edges between them, within reach (Goedemé 2007 eq. 13).
class MotionModel {
 public:
  /// spread_hops: standard deviation of the edges driven between two updates.
  MotionModel(const map::PlaceGraph& graph, double spread_hops, int max_hops);

  /// Where the robot is one update after `belief`, each place once and ascending. Keeps the sum. Its cost follows the
  /// places of `belief`, not those of the map.
  [[nodiscard]] std::vector<PlaceShare> predict(std::span<const PlaceShare> belief) const;

  [[nodiscard]] int places() const { return static_cast<int>(steps_.size()); }

 private:
  std::vector<std::vector<PlaceShare>> steps_;  // from each place
};

}  // namespace homeward::localisation
