// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <span>
#include <vector>

#include "map/topological_map.hpp"
#include "mapping/seen_floor.hpp"

namespace homeward::mapping {

/// Where the values come from: docs/experiments/shortcuts.md.
struct ShortcutConfig {
  double least_m = 0.4;          // nearer pictures do not say which way the other is
  double most_m = 6.0;           // between the two viewpoints: the second is still homed to
  double stretch = 1.3;          // so many times the straight way the map's way must be long,
  double saves_m = 1.0;          // and so much longer
  double half_body_m = 0.35;     // of a body that drives it
  double margin_m = 0.1;         // and room on each side
  double sweeps_within_m = 6.0;  // of the middle of the way, they say whether it is free
  double confidence = 0.2;       // of each picture's bearing by itself, as for sound edges; the layout bears it out
  double bearing_rad = 0.14;     // by which these may differ from the layout's,
  double layout_m = 0.1;         // beside what so much of the layout's error across the way makes of it
  double turn_rad = 0.09;        // and the turn
  double agreement = 0.8;        // of what both sweeps see (SeenFloor::agreement), both ways
  int least_hits = 30;           // that both see
};

/// Straight ways between the prototypes of two places that no edge joins and whose way over the map's edges is clearly
/// longer, where three things agree: the verified pose of the two pictures, in both directions; the floor that sweeps
/// of the tour saw free, as wide as the body with its margin; and the map's metric layout, in which the two sweeps see
/// the same things where they are. Only such as still shorten the way between their own two places when those before
/// them are driven: shortest first, as in the greedy spanner (Althöfer, Das, Dobkin, Joseph, Soares, On sparse spanners
/// of weighted graphs, 1993); those that later ones made needless are taken out again. Those that save most come first.
/// What a person rejected between two places is not proposed again. Lengths are the layout's, also those of edges, and
/// blocked edges count as open: what a person closed gives no reason for a way round it. All are kProposed. Same map
/// and sweeps, same shortcuts.
/// That these three agree is ours.
std::vector<map::Shortcut> propose_shortcuts(const map::TopologicalMap& map, std::span<const TourSweep> sweeps,
                                             const ShortcutConfig& config = {});

}  // namespace homeward::mapping
