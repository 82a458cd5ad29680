// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <vector>

#include "map/graph.hpp"

namespace homeward::localisation {

/// P(x | x') between places: a Gaussian of the number of edges between them, within reach (Goedemé 2007 eq. 13).
class MotionModel {
 public:
  /// spread_hops: standard deviation of the edges driven between two updates.
  MotionModel(const map::PlaceGraph& graph, double spread_hops, int max_hops);

  /// Where the robot is one update after `belief` over the places. Keeps the sum.
  [[nodiscard]] std::vector<double> predict(const std::vector<double>& belief) const;

 private:
  struct Step {
    int place = 0;
    double probability = 0.0;
  };
  std::vector<std::vector<Step>> steps_;  // from each place
};

}  // namespace homeward::localisation
