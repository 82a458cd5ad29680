// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "localisation/motion_model.hpp"
#include "map/graph.hpp"
#include "map/topological_map.hpp"

namespace homeward::localisation {

/// Where a robot is after a drive of known length, and how much of the belief had no such drive on the map.
struct DrivenBelief {
  std::vector<PlaceShare> shares;  // each place once, ascending
  double unexplained = 0.0;        // probability; with the shares it makes the sum of the belief before
};

/// P(x | x') between places when odometry tells how far the robot drove: a Gaussian of the difference between that and
/// the length of the way through the map. Its spread is that of the odometry, of the lengths, which are as good as what
/// they were taken from, and of the places: a robot may stand anywhere in them.
/// Goedemé 2007 eq. 13 with metres in place of place transitions: ours.
class MetricMotion {
 public:
  /// `map` need not outlive the model.
  MetricMotion(const map::TopologicalMap& map, const map::PlaceGraph& graph);

  /// Where the robot is `driven_m` after `belief`, places ascending and each once; at 0 it is where it was. Its cost
  /// follows the places of `belief` and the way driven, not the map.
  [[nodiscard]] DrivenBelief predict(std::span<const PlaceShare> belief, double driven_m) const;

  /// Odometry that says more between two pictures says nothing.
  [[nodiscard]] static double longest_m();

 private:
  struct Way {
    int to = 0;
    double length_m = 0.0;
    double sigma_m = 0.0;
  };
  /// Not yet divided by their sum; in the order of the way's length.
  [[nodiscard]] std::vector<PlaceShare> likely_from(int from, double driven_m) const;

  std::vector<std::vector<Way>> ways_;  // from each place
  std::vector<double> extent_m_;        // of each place along the ways
};

}  // namespace homeward::localisation
